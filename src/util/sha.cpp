#include "util/sha.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

namespace bristle {
namespace {

void check(bool succeeded) {
  if (!succeeded) throw RunError("libcrypto: computing a SHA-2 digest failed");
}

std::string hex_of(Sha algorithm, std::string_view text) {
  Digest digest(algorithm);
  digest.add(text);
  return digest.hex();
}

}  // namespace

Digest::Digest(Sha algorithm) : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
  check(context_ != nullptr);
  check(EVP_DigestInit_ex(context_.get(), algorithm == Sha::bits_256 ? EVP_sha256() : EVP_sha512(),
                          nullptr) == 1);
}

void Digest::add(const void* data, std::size_t bytes) {
  check(EVP_DigestUpdate(context_.get(), data, bytes) == 1);
}

std::string Digest::hex() {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned length = 0;
  check(EVP_DigestFinal_ex(context_.get(), digest, &length) == 1);
  return fmt::format("{:02x}", fmt::join(digest, digest + length, ""));
}

std::string sha256_of(std::string_view text) { return hex_of(Sha::bits_256, text); }
std::string sha512_of(std::string_view text) { return hex_of(Sha::bits_512, text); }

}  // namespace bristle
