#include "digest.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <vector>

#include "handles.h"

namespace slopemix::cli {

namespace {

void require(int success) {
    if (success != 1) throw CommandError("SHA-256 is not available");
}

class Digest {
  public:
    Digest() { require(EVP_DigestInit_ex(state_.get(), EVP_sha256(), nullptr)); }

    void add(std::string_view bytes) { require(EVP_DigestUpdate(state_.get(), bytes.data(), bytes.size())); }

    std::string hex() {
        std::array<unsigned char, 32> digest{};
        require(EVP_DigestFinal_ex(state_.get(), digest.data(), nullptr));
        constexpr char digits[] = "0123456789abcdef";
        std::string text;
        for (const unsigned char byte : digest) {
            text += digits[byte >> 4];
            text += digits[byte & 15];
        }
        return text;
    }

  private:
    std::unique_ptr<EVP_MD_CTX, Release<EVP_MD_CTX_free>> state_{EVP_MD_CTX_new()};
};

} // namespace

std::string sha256_of(std::string_view bytes) {
    Digest digest;
    digest.add(bytes);
    return digest.hex();
}

std::string sha256_of_file(const std::filesystem::path &file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return "";
    Digest digest;
    std::vector<char> block(std::size_t{1} << 20);
    do {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        digest.add({block.data(), static_cast<std::size_t>(stream.gcount())});
    } while (stream);
    return stream.eof() ? digest.hex() : "";
}

} // namespace slopemix::cli
