#include "gateway/access/secrets.hpp"

#include <openssl/evp.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
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

std::string digits_of(std::span<unsigned char const> bytes) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (auto const byte : bytes) {
        text.push_back(digits[byte >> 4]);
        text.push_back(digits[byte & 15]);
    }
    return text;
}

// Returns random bits in base64url, without padding.
template <std::size_t bytes>
std::string random_text() {
    std::array<unsigned char, bytes> random{};
    if (RAND_bytes(random.data(), random.size()) != 1) throw std::runtime_error{"the system gives no random bytes"};
    auto text = base64(random.data(), random.size());
    std::ranges::replace(text, '+', '-');
    std::ranges::replace(text, '/', '_');
    return text.substr(0, text.find('='));
}

}  // namespace

std::string fresh_secret() { return random_text<24>(); }

std::string fresh_token() { return random_text<32>(); }

std::string from_base64url(std::string_view text) {
    auto padded = std::string{text};
    std::ranges::replace(padded, '-', '+');
    std::ranges::replace(padded, '_', '/');
    auto const missing = (4 - padded.size() % 4) % 4;
    if (text.find_first_of("+/=") != text.npos || missing > 2) return {};
    padded.append(missing, '=');
    std::string bytes(padded.size() / 4 * 3, '\0');
    auto const size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                      reinterpret_cast<unsigned char const*>(padded.data()), static_cast<int>(padded.size()));
    if (size < 0) return {};
    bytes.resize(static_cast<std::size_t>(size) - missing);
    return bytes;
}

Sha256 sha256(std::string_view content) {
    auto const bytes = hash(content, EVP_sha256());
    Sha256 result{};
    std::ranges::copy(bytes, result.begin());
    return result;
}

std::string to_text(Sha256 const& hash) { return digits_of(hash); }

std::optional<Sha256> read_sha256(std::string_view text) {
    Sha256 hash{};
    if (text.size() != 2 * hash.size()) return {};
    for (std::size_t i = 0; i < hash.size(); ++i) {
        auto const* const begin = text.data() + 2 * i;
        auto const [end, error] = std::from_chars(begin, begin + 2, hash[i], 16);
        if (error != std::errc{} || end != begin + 2) return {};
    }
    return hash;
}

std::string digest(std::string_view content) {
    auto const bytes = hash(content, EVP_sha256());
    return digits_of(std::span{bytes}.first(8));
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
