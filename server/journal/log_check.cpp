#include "journal/log_check.hpp"

#include <unistd.h>

#include <array>
#include <boost/endian/conversion.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

namespace rois::journal {

namespace {

constexpr std::uint32_t magic = 0x377f0682;  // or the next number: then the sums are of big-endian words
constexpr std::size_t head_of_log = 32, head_of_frame = 24, page = 4'096;

using Bytes = std::span<unsigned char const>;
using Sum = std::pair<std::uint32_t, std::uint32_t>;

std::uint32_t word(Bytes bytes, std::size_t at) { return boost::endian::load_big_u32(bytes.data() + at); }

Sum sum_of(Bytes bytes, bool is_big, Sum sum) {
    auto const load = is_big ? boost::endian::load_big_u32 : boost::endian::load_little_u32;
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
        sum.first += load(bytes.data() + at) + sum.second;
        sum.second += load(bytes.data() + at + 4) + sum.first;
    }
    return sum;
}

bool read_all(int file, std::span<unsigned char> into, std::size_t at) {
    return ::pread(file, into.data(), into.size(), static_cast<off_t>(at)) == static_cast<ssize_t>(into.size());
}

}  // namespace

bool is_damaged_log(int file) {
    std::array<unsigned char, head_of_log> head{};
    std::array<unsigned char, head_of_frame + page> frame{};
    if (!read_all(file, head, 0) || !read_all(file, frame, head_of_log)) return false;
    bool const is_big = word(head, 0) == magic + 1;
    auto sum = sum_of(Bytes{head}.first(24), is_big, {});
    bool is_whole = (is_big || word(head, 0) == magic) && word(head, 8) == page && sum == Sum{word(head, 24), word(head, 28)};
    // Frames of an earlier use of the file have another salt. Without a head, it is not known which salt is the present one.
    auto const salt_at = [](Bytes bytes, std::size_t at) { return Sum{word(bytes, at), word(bytes, at + 4)}; };
    bool const has_head = is_whole;
    std::map<Sum, int> commits_behind;  // by salt
    for (auto at = head_of_log; read_all(file, frame, at); at += frame.size()) {
        auto const salt = salt_at(frame, 8);
        bool const is_of_log = !has_head || salt == salt_at(head, 16);
        sum = sum_of(Bytes{frame}.subspan(head_of_frame), is_big, sum_of(Bytes{frame}.first(8), is_big, sum));
        is_whole = is_whole && is_of_log && sum == salt_at(frame, 16);
        if (!is_whole && is_of_log && word(frame, 4) != 0 && ++commits_behind[salt] >= 2) return true;
    }
    return false;
}

}  // namespace rois::journal
