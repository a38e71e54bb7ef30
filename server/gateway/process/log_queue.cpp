#include "gateway/process/log_queue.hpp"

#include <poll.h>
#include <spdlog/pattern_formatter.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <span>
#include <string_view>
#include <utility>

namespace rois {

namespace {

constexpr std::chrono::milliseconds between_looks{100};  // of the thread at the file and the queue
constexpr std::size_t atomic_write = 4'096;              // PIPE_BUF: a pipe that is writable takes so much without blocking
constexpr std::size_t longest_example = 80;

// Returns a hash (FNV-1a) of the line without its digits and without everything between its first and last quotation mark. Pairs
// of marks cannot be matched, because a quoted text may contain marks itself.
std::uint64_t cause_of(std::string_view line) {
    constexpr std::string_view marks = "'\"";
    std::uint64_t hash = 14'695'981'039'346'656'037U;
    auto const add = [&](std::string_view part) {
        for (char const c : part)
            if (c < '0' || c > '9') hash = (hash ^ static_cast<unsigned char>(c)) * 1'099'511'628'211U;
    };
    auto const first = line.find_first_of(marks);
    add(line.substr(0, first));
    if (first != line.npos) add(line.substr(line.find_last_of(marks)));
    return hash;
}

// Waits until the file accepts bytes, or until it is time to give up.
bool is_writable(int file, std::atomic<Steady> const& give_up, Steady (*now)()) {
    while (now() < give_up.load()) {
        pollfd asked{file, POLLOUT, 0};
        auto const ready = ::poll(&asked, 1, static_cast<int>(between_looks.count()));
        if (ready > 0) return (asked.revents & POLLOUT) != 0;
        if (ready < 0 && errno != EINTR) return false;
    }
    return false;
}

// Writes the level in color. The formatter has found its place.
void colour(spdlog::memory_buf_t& text, std::size_t begin, spdlog::details::log_msg const& message) {
    if (message.color_range_end <= message.color_range_start) return;
    constexpr std::string_view red = "\033[31m", yellow = "\033[33m", green = "\033[32m", plain = "\033[m";
    auto const& paint = message.level >= spdlog::level::err ? red : message.level == spdlog::level::warn ? yellow : green;
    std::string line{text.data() + begin, text.size() - begin};
    line.insert(message.color_range_end, plain).insert(message.color_range_start, paint);
    text.resize(begin);
    text.append(line.data(), line.data() + line.size());
}

}  // namespace

LogQueue::LogQueue(int file, Limits const& limits)
    : file_{file}, is_terminal_{::isatty(file) == 1}, limits_{limits}, formatter_{std::make_unique<spdlog::pattern_formatter>()} {
    thread_ = std::jthread{[this](std::stop_token const& stop) { run(stop); }};
}

LogQueue::~LogQueue() {
    give_up_ = limits_.now() + limits_.flush;
    thread_.request_stop();
    news_.notify_all();
}

void LogQueue::set_pattern(std::string const& pattern) { set_formatter(std::make_unique<spdlog::pattern_formatter>(pattern)); }

void LogQueue::set_formatter(std::unique_ptr<spdlog::formatter> formatter) {
    std::lock_guard const lock{mutex_};
    formatter_ = std::move(formatter);
}

void LogQueue::log(spdlog::details::log_msg const& message) {
    std::lock_guard const lock{mutex_};
    try {
        if (may_say(message)) put({message.time, message.level, {message.payload.data(), message.payload.size()}});
    } catch (...) {
        ++dropped_;  // there was no memory
    }
    news_.notify_one();
}

// Returns the place of this cause, else an expired place near it, else one that another cause uses, too.
LogQueue::Cause& LogQueue::place_of(std::uint64_t hash, Steady now) {
    constexpr std::size_t near_by = 4;
    auto const begin = hash % (causes_.size() - near_by);
    auto const places = std::span{causes_}.subspan(begin, near_by);
    auto const own = std::ranges::find(places, hash, &Cause::hash);
    if (own != places.end()) return *own;
    auto const old =
        std::ranges::find_if(places, [&](Cause const& cause) { return now - cause.since >= std::chrono::seconds{1}; });
    return old != places.end() ? *old : places.front();
}

bool LogQueue::may_say(spdlog::details::log_msg const& message) {
    auto const hash = cause_of({message.payload.data(), message.payload.size()});
    auto const now = limits_.now();
    auto& cause = place_of(hash, now);
    if (now - cause.since >= std::chrono::seconds{1}) {
        sum_up(cause);
        cause = {.hash = hash, .since = now, .level = message.level, .example = {}};
    }
    if (cause.said < limits_.a_second) return ++cause.said > 0;
    if (cause.left_out == 0) cause.example.assign(message.payload.data(), std::min(message.payload.size(), longest_example));
    ++cause.left_out;
    ++left_out_;
    return false;
}

// Adds one line about the lines that were left out.
void LogQueue::sum_up(Cause& cause) {
    auto const left_out = std::exchange(cause.left_out, 0);
    if (left_out == 0) return;
    put({spdlog::log_clock::now(), cause.level,
         std::to_string(left_out) + " more lines like this one were left out: " + cause.example});
}

void LogQueue::put(Line line) {
    while (!lines_.empty() && (lines_.size() >= limits_.lines || bytes_ + line.text.size() > limits_.bytes)) {
        bytes_ -= lines_.front().text.size();
        lines_.pop_front();
        ++dropped_;
    }
    auto const size = line.text.size();
    lines_.push_back(std::move(line));
    bytes_ += size;
}

// Reports left-out lines of causes whose second is over, without waiting for their next line.
void LogQueue::report_suppressed_lines(Steady now) {
    for (auto& cause : causes_)
        if (cause.left_out > 0 && now - cause.since >= std::chrono::seconds{1}) sum_up(cause);
}

void LogQueue::flush() {
    std::unique_lock lock{mutex_};
    auto const done = [this] { return lines_.empty() && !writing_; };
    written_.wait_for(lock, limits_.flush, done);
}

// Returns false at the end.
bool LogQueue::take(std::unique_lock<std::mutex>& lock, std::stop_token const& stop, Line& line) {
    writing_ = false;
    if (lines_.empty()) written_.notify_all();
    while (lines_.empty()) {
        if (stop.stop_requested()) return false;
        news_.wait_for(lock, between_looks);
        report_suppressed_lines(limits_.now());
    }
    line = std::move(lines_.front());
    lines_.pop_front();
    bytes_ -= line.text.size();
    return writing_ = true;
}

void LogQueue::run(std::stop_token const& stop) {
    std::unique_lock lock{mutex_};
    Line line;
    while (true) {
        try {
            if (!take(lock, stop, line)) return;
            lock.unlock();
            write(line);
        } catch (...) {
            ++dropped_;  // there was no memory
        }
        if (!lock.owns_lock()) lock.lock();
    }
}

void LogQueue::write(Line const& line) {
    spdlog::memory_buf_t text;
    auto const append = [&](Line const& each) {
        spdlog::details::log_msg message{each.time, {}, "rois-gateway", each.level, each.text};
        auto const begin = text.size();
        formatter_->format(message, text);
        if (is_terminal_) colour(text, begin, message);
    };
    auto const lost = dropped_.load();
    if (lost > reported_dropped_)
        append({line.time, spdlog::level::warn,
                std::to_string(lost - reported_dropped_) + " lines of the log were dropped: they could not be written"});
    append(line);
    if (write({text.data(), text.size()}))
        reported_dropped_ = std::max(reported_dropped_, lost);
    else
        ++dropped_;
}

bool LogQueue::write(std::string_view text) {
    while (!text.empty()) {
        if (!is_writable(file_, give_up_, limits_.now)) return false;
        auto const size = ::write(file_, text.data(), std::min(text.size(), atomic_write));
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) return false;
        text.remove_prefix(static_cast<std::size_t>(size));
    }
    return true;
}

}  // namespace rois
