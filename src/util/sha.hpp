#pragma once

#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace bristle {

enum class Sha {
  bits_256,
  bits_512
};

// SHA-2 of bytes that are added in pieces, computed by libcrypto. Throws RunError if the library fails.
class Digest {
 public:
  explicit Digest(Sha algorithm);
  void add(const void* data, std::size_t bytes);
  void add(std::string_view text) { add(text.data(), text.size()); }
  std::string hex();  // call once, after the last add()

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

std::string sha256_of(std::string_view text);
std::string sha512_of(std::string_view text);

}  // namespace bristle
