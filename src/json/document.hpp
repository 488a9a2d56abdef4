#pragma once

#include "json/assignment.hpp"
#include "json/json.hpp"
#include "json/table.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace bristle::json {

// Changes to an experiment file that the command line requests.
struct DocumentOptions {
  std::vector<std::string> set;  // "/json/pointer=value"
  std::string tier = "full";
};

// An experiment file merged with its parents (extends), the patches of the tier and the --set changes.
// Bristles in SI units bend like rods and touch the slab by Hertz's contact, unless the file with the si
// block, or one that changes it, says otherwise. Remembers the source of each value for messages.
class Document {
 public:
  // Reads an experiment file. path: the file, or - for standard input. Throws InputError for an unreadable or
  // malformed file or table, for an extends that is missing, circular or outside the experiments folder, and
  // for an invalid --set.
  static Document load(const std::string& path, const DocumentOptions& options);
  // Returns an experiment as stored in a result file: merged, without tiers; set: changes as of
  // DocumentOptions. source names the experiment in messages.
  static Document stored(const Json& content, const std::string& source,
                         const std::vector<std::string>& set = {});
  // Returns an experiment that the program has made: messages say only the pointer, as there is no file.
  static Document made(const Json& content);

  const Json& json() const { return *merged_; }
  const std::string& path() const { return path_; }
  // Returns the file or option that sets the value at pointer; the experiment's own file for a default.
  std::string origin(const JsonPointer& pointer) const;
  // Returns true if the experiment's own file or --set gives the value at pointer. The values of a file
  // without parents, which states every value, do not count.
  bool chosen(const JsonPointer& pointer) const;
  // Returns true if a file that this one extends gives the value at pointer, and neither this file nor --set.
  bool inherits(const JsonPointer& pointer) const;
  // Returns true if --set gives the value at pointer.
  bool set_by_option(const JsonPointer& pointer) const;
  // Throws InputError with the place of the value (its origin and JSON pointer, or its line in the file of a
  // table) and the description of the mistake.
  [[noreturn]] void fail(const std::string& pointer, const std::string& what) const;
  // Returns true if this tier differs from the others, by a patch of the file or of a parent.
  bool has_tier(const std::string& tier) const;
  // Returns how this file replaces the tier's patch of a file that it extends; empty if there is none.
  std::string remedy_of_inherited_tier(const std::string& tier) const;
  // Returns the same document for another tier.
  Document with_tier(const std::string& tier) const;

  struct Source {
    std::string name;
    std::shared_ptr<const Json> content;
  };

 private:
  std::vector<Json> tier_patches(const std::string& tier) const;
  // Returns the last file that has a value at pointer, in its tier's patch or outside; null if none has.
  const Source* source_of(const JsonPointer& pointer) const;
  // Returns the tier whose patch sets the value at pointer; empty if no patch does.
  std::string tier_of(const JsonPointer& pointer) const;
  void merge();
  // Reads the table at a place if `merged` has only the name of its file there, and puts it in place of the
  // name, so that the experiment contains all that determines its numbers. A table that is replaced or
  // removed is not read.
  void include_table(Json& merged, const JsonPointer& at);
  // Returns the place of a value for messages: its line in the file of the table, or its origin and pointer.
  std::string place(const std::string& pointer) const;

  std::string path_, tier_;
  bool made_ = false;
  std::map<std::string, Table> tables_;  // by their JSON pointers; only tables that come whole from a file
  std::vector<Source> files_;            // parents first
  std::vector<Assignment> set_;
  std::shared_ptr<const Json> merged_;
};

}  // namespace bristle::json
