#pragma once

#include "json/document.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace bristle::json {

// A value of a document, which may be missing, and its place. The document must outlive the node.
class Node {
 public:
  // Returns the node at a JSON pointer, such as "/design/budget".
  Node(const Document& document, const std::string& pointer)
      : Node(document, JsonPointer(pointer),
             document.json().contains(JsonPointer(pointer)) ? &document.json().at(JsonPointer(pointer))
                                                            : nullptr) {}

  Node operator[](const std::string& key) const {
    return {*document_, at_ / key, has(key) ? &(*value_)[key] : nullptr};
  }
  Node operator[](std::size_t index) const {
    return {*document_, at_ / index, exists() && index < value_->size() ? &(*value_)[index] : nullptr};
  }
  bool exists() const { return value_ != nullptr; }
  bool has(const std::string& key) const { return value_ && value_->is_object() && value_->contains(key); }
  // Returns the value, which must exist.
  const Json& value() const { return *value_; }
  template <class T>
  T as() const {
    return value_->get<T>();
  }
  // Returns the value of a key, or `otherwise` if the key is missing.
  template <class T>
  T get(const std::string& key, T otherwise) const {
    return has(key) ? (*value_)[key].get<T>() : otherwise;
  }
  // Returns the members of an object by their keys; none if the object is missing.
  std::vector<std::pair<std::string, Node>> members() const {
    std::vector<std::pair<std::string, Node>> out;
    if (exists())
      for (const auto& [key, value] : value_->items())
        out.emplace_back(key, Node(*document_, at_ / key, &value));
    return out;
  }
  // Returns the elements of an array; none if the array is missing.
  std::vector<Node> elements() const {
    std::vector<Node> out;
    for (std::size_t i = 0; exists() && i < value_->size(); ++i) out.push_back((*this)[i]);
    return out;
  }
  // Throws InputError that names the source of the value, its JSON pointer and the mistake.
  [[noreturn]] void fail(const std::string& mistake) const { document_->fail(at_.to_string(), mistake); }
  const Document& document() const { return *document_; }

 private:
  Node(const Document& document, JsonPointer at, const Json* value)
      : document_(&document), at_(std::move(at)), value_(value) {}

  const Document* document_;
  JsonPointer at_;
  const Json* value_;
};

}  // namespace bristle::json
