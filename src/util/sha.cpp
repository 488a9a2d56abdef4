#include "util/sha.hpp"

#include "util/error.hpp"

#include <openssl/evp.h>

namespace bristle {

struct Digest::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~State() { EVP_MD_CTX_free(context); }
  static void check(int code) {
    if (code != 1) throw RunError("libcrypto: computing a SHA-2 digest failed");
  }
};

Digest::Digest(Sha algorithm) : state_(std::make_unique<State>()) {
  State::check(state_->context != nullptr);
  const EVP_MD* method = algorithm == Sha::bits_256 ? EVP_sha256() : EVP_sha512();
  State::check(EVP_DigestInit_ex(state_->context, method, nullptr));
}

Digest::~Digest() = default;

void Digest::add(const void* data, std::size_t bytes) {
  State::check(EVP_DigestUpdate(state_->context, data, bytes));
}

std::string Digest::hex() {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned length = 0;
  State::check(EVP_DigestFinal_ex(state_->context, digest, &length));
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * std::size_t(length));
  for (unsigned i = 0; i < length; ++i) {
    text += digits[digest[i] / 16];
    text += digits[digest[i] % 16];
  }
  return text;
}

namespace {

std::string hex_of(Sha algorithm, std::string_view text) {
  Digest digest(algorithm);
  digest.add(text);
  return digest.hex();
}

}  // namespace

std::string sha256_of(std::string_view text) { return hex_of(Sha::bits_256, text); }
std::string sha512_of(std::string_view text) { return hex_of(Sha::bits_512, text); }

}  // namespace bristle
