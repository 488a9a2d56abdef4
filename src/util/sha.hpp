#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace bristle {

enum class Sha {
  bits_256,
  bits_512
};

// SHA-2 of bytes that are added in pieces, computed by libcrypto. Throws RunError if the library fails.
class Digest {
 public:
  explicit Digest(Sha algorithm);
  ~Digest();
  void add(const void* data, std::size_t bytes);
  void add(std::string_view text) { add(text.data(), text.size()); }
  std::string hex();  // call once, after the last add()

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string sha256_of(std::string_view text);
std::string sha512_of(std::string_view text);

}  // namespace bristle
