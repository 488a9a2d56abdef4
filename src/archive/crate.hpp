#pragma once

#include "archive/contents.hpp"

#include <string>
#include <vector>

// Metadata of the payload: RO-Crate 1.1 with the profile Process Run Crate 0.5.
namespace bristle::archive {

constexpr const char* kCrateFile = "ro-crate-metadata.json";

// The text of the crate. contents.payload must contain all files except the crate.
std::string crate_text(const Contents& contents);

// Entities of the crate for people and publications of a citation (Citation File Format).

// A reference to an entity: {"@id": name}.
Json id(const std::string& name);
Json ids(const std::vector<std::string>& names);

std::string doi_address(const Json& doi);

// The ORCID, or else "#role-<index + 1>".
std::string person_id(const Json& person, const std::string& role, std::size_t index);

// Each adds entities and returns the references to them.
Json add_people(const Json& people, const std::string& role, std::vector<Json>& entities);
Json add_article(const Json& article, std::vector<Json>& entities);

}  // namespace bristle::archive
