#pragma once

#include <memory>
#include <string>

namespace bristle {

// SHA-256 over bytes fed in pieces, by libcrypto. Throws RunError if the library refuses.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void add(const void* data, std::size_t bytes);
  void add(const std::string& text) { add(text.data(), text.size()); }
  std::string hex();  // ends the digest

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string sha256_of(const std::string& text);

}  // namespace bristle
