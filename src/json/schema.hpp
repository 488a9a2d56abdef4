#pragma once

#include "json/document.hpp"
#include "json/node.hpp"

namespace bristle::json {

// A JSON schema (draft 7, with references to its own definitions), whose violations are explained in words.
class Schema {
 public:
  // Returns where a key belongs that is unknown at its place, in words; empty if it belongs nowhere.
  using Elsewhere = std::string (*)(const std::string& key);
  explicit Schema(Json root, Elsewhere elsewhere = nullptr) : root_(std::move(root)), elsewhere_(elsewhere) {}

  // Throws InputError for a document that does not match, with source, JSON pointer, the invalid value and
  // what is allowed.
  void check(const Document& document) const;
  // Returns true if the value matches a part of the schema.
  bool matches(const Json& part, const Json& value) const;
  // Returns what a part of the schema allows: "a number greater than 0 (radial stiffness, dimensionless)".
  std::string allowed(const Json& part) const;
  const Json& root() const { return root_; }

 private:
  const Json& resolve(const Json& part) const;
  const Json& member(const Json& part, const std::string& token) const;
  [[noreturn]] void explain(const Node& node, const Json& part) const;
  void require_short_name(const Node& name) const;

  Json root_;
  Elsewhere elsewhere_;
};

}  // namespace bristle::json
