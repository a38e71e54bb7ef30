#include "gateway/access/secrets.hpp"

#include <openssl/evp.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

namespace rois {

namespace {

std::string base64(unsigned char const* bytes, std::size_t size) {
    std::string text((size + 2) / 3 * 4 + 1, '\0');  // one more for the NUL that OpenSSL writes
    text.resize(
        static_cast<std::size_t>(EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes, static_cast<int>(size))));
    return text;
}

std::vector<unsigned char> hash(std::string_view text, EVP_MD const* kind) {
    std::vector<unsigned char> bytes(EVP_MAX_MD_SIZE);
    unsigned int size = 0;
    if (EVP_Digest(text.data(), text.size(), bytes.data(), &size, kind, nullptr) != 1)
        throw std::runtime_error{"OpenSSL cannot hash"};
    bytes.resize(size);
    return bytes;
}

}  // namespace

std::string fresh_secret() {
    std::array<unsigned char, 24> bytes{};
    if (RAND_bytes(bytes.data(), bytes.size()) != 1) throw std::runtime_error{"no randomness for session ids"};
    auto text = base64(bytes.data(), bytes.size());
    std::ranges::replace(text, '+', '-');
    std::ranges::replace(text, '/', '_');
    return text;
}

std::string digest(std::string_view content) {
    static constexpr char digits[] = "0123456789abcdef";
    auto const bytes = hash(content, EVP_sha256());
    std::string text;
    for (std::size_t i = 0; i < 8; ++i) {
        text.push_back(digits[bytes[i] >> 4]);
        text.push_back(digits[bytes[i] & 15]);
    }
    return text;
}

std::string sha256_base64(std::string_view content) {
    auto const bytes = hash(content, EVP_sha256());
    return base64(bytes.data(), bytes.size());
}

std::string sha1_base64(std::string_view content) {
    auto const bytes = hash(content, EVP_sha1());
    return base64(bytes.data(), bytes.size());
}

}  // namespace rois
