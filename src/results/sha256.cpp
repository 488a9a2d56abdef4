#include "results/sha256.hpp"

#include "experiment/input_error.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

namespace bristle {

struct Sha256::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~State() { EVP_MD_CTX_free(context); }
  static void check(int code) {
    if (code != 1) throw RunError("libcrypto: SHA-256 failed");
  }
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  State::check(state_->context != nullptr);
  State::check(EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr));
}

Sha256::~Sha256() = default;

void Sha256::add(const void* data, std::size_t bytes) {
  State::check(EVP_DigestUpdate(state_->context, data, bytes));
}

std::string Sha256::hex() {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned length = 0;
  State::check(EVP_DigestFinal_ex(state_->context, digest, &length));
  std::string text;
  for (unsigned i = 0; i < length; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string sha256_of(const std::string& text) {
  Sha256 digest;
  digest.add(text);
  return digest.hex();
}

}  // namespace bristle
