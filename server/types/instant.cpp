#include "types/instant.hpp"

#include <algorithm>
#include <charconv>

#include "types/text/texts.hpp"

namespace rois {

namespace {

using namespace std::chrono;

// Takes numbers and signs from the front of a text.
class Taker {
public:
    explicit Taker(std::string_view text) : rest_{text} {}

    // Takes a number of exactly `digits` digits.
    std::optional<int> number(std::size_t digits) {
        if (rest_.size() < digits) return {};
        int value = 0;
        auto const taken = rest_.substr(0, digits);
        auto const [end, problem] = std::from_chars(taken.data(), taken.data() + taken.size(), value);
        if (problem != std::errc{} || end != taken.data() + taken.size() || taken.front() == '-') return {};
        rest_.remove_prefix(digits);
        return value;
    }

    // Takes the sign and a number of two digits, up to `most`, such as "-05".
    std::optional<int> part(char sign, int most) {
        if (!sign_is(sign)) return {};
        auto const value = number(2);
        return value && *value <= most ? value : std::nullopt;
    }

    bool sign_is(char sign) {
        if (!rest_.starts_with(sign)) return false;
        rest_.remove_prefix(1);
        return true;
    }

    // Takes a fraction such as ".123", with any number of digits. Returns 0 if there is no point.
    std::optional<nanoseconds> fraction() {
        if (!sign_is('.')) return nanoseconds{0};
        nanoseconds sum{0};
        auto unit = nanoseconds{100'000'000};
        std::size_t digits = 0;
        for (; !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; rest_.remove_prefix(1), ++digits, unit /= 10)
            sum += unit * (rest_.front() - '0');
        return digits > 0 ? std::optional{sum} : std::nullopt;
    }

    // Takes "Z", "+09:00" or nothing. Returns the offset, to be subtracted to get UTC.
    std::optional<minutes> offset() {
        if (at_end() || sign_is('Z')) return minutes{0};
        int const sign = rest_.front() == '-' ? -1 : 1;
        auto const hours = part(sign < 0 ? '-' : '+', 14);
        auto const rest = hours ? part(':', *hours == 14 ? 0 : 59) : std::nullopt;
        if (!rest) return {};
        return sign * minutes{*hours * 60 + *rest};
    }

    bool at_end() const { return rest_.empty(); }

private:
    std::string_view rest_;
};

Utc moment(sys_days day, nanoseconds time) {
    year const shown{year_month_day{day}.year()};
    if (shown < year{1678}) return Utc::min();
    if (shown > year{2261}) return Utc::max();
    return Utc{day} + duration_cast<Utc::duration>(time);
}

std::optional<sys_days> day_of(int year, int month, int day) {
    year_month_day const date{std::chrono::year{year}, std::chrono::month{static_cast<unsigned>(month)},
                              std::chrono::day{static_cast<unsigned>(day)}};
    return date.ok() ? std::optional{sys_days{date}} : std::nullopt;
}

// Overwrites zeros in the text with the number, its last digit at index `last`.
template <class Number>
void put(std::string& text, std::size_t last, Number number) {
    for (auto rest = static_cast<unsigned>(number); rest > 0; rest /= 10) text[last--] = static_cast<char>('0' + rest % 10);
}

// Writes "2026-11-20T12:00" to the front of the text.
void put_minute(std::string& text, year_month_day const& date, auto const& clock) {
    put(text, 3, static_cast<int>(date.year()));
    put(text, 6, static_cast<unsigned>(date.month()));
    put(text, 9, static_cast<unsigned>(date.day()));
    put(text, 12, clock.hours().count());
    put(text, 15, clock.minutes().count());
}

std::optional<Period> whole_days(year_month_day const& first, year_month_day const& next) {
    if (!first.ok()) return {};
    return Period{moment(sys_days{first}, nanoseconds{0}), moment(sys_days{next}, nanoseconds{0})};
}

}  // namespace

std::optional<Utc> to_utc(std::string_view text) {
    Taker taker{trimmed(text)};
    auto const year = taker.number(4);
    auto const month = year ? taker.part('-', 12) : std::nullopt;
    auto const day = month ? taker.part('-', 31) : std::nullopt;
    if (!day || !taker.sign_is('T')) return {};
    auto const hour = taker.number(2);
    auto const minute = hour && *hour <= 23 ? taker.part(':', 59) : std::nullopt;
    auto const second = minute ? taker.part(':', 59) : std::nullopt;
    auto const fraction = second ? taker.fraction() : std::nullopt;
    auto const offset = fraction ? taker.offset() : std::nullopt;
    auto const date = offset ? day_of(*year, *month, *day) : std::nullopt;
    if (!date || !taker.at_end()) return {};
    return moment(*date, hours{*hour} + minutes{*minute} + seconds{*second} + *fraction - *offset);
}

std::optional<Period> to_period(std::string_view text) {
    if (auto const time = to_utc(text)) return Period{*time, *time};
    Taker taker{trimmed(text)};
    auto const number = taker.number(4);
    if (!number) return {};
    std::chrono::year const year{*number};
    if (taker.at_end()) return whole_days(year / January / 1, (year + years{1}) / January / 1);
    auto const month = taker.part('-', 12);
    if (!month) return {};
    auto const days = year / std::chrono::month{static_cast<unsigned>(*month)};
    if (taker.at_end()) return whole_days(days / 1, (days + months{1}) / 1);
    auto const day = taker.part('-', 31);
    if (!day || !taker.at_end()) return {};
    auto const date = day_of(*number, *month, *day);
    if (!date) return {};
    return whole_days(year_month_day{*date}, year_month_day{*date + std::chrono::days{1}});
}

std::string in_utc(std::string_view text) {
    constexpr std::size_t date_and_time = 19;  // "2026-11-20T12:00:00"
    auto const written = trimmed(text);
    if (!to_utc(written) || written.ends_with('Z')) return std::string{to_utc(written) ? written : text};
    auto const end_of_second = std::min(written.find_first_of("+-", date_and_time), written.size());
    Taker clock{written}, zone{written.substr(end_of_second)};
    auto const year = clock.number(4), month = clock.part('-', 12), day = clock.part('-', 31);
    clock.sign_is('T');
    auto const hour = clock.number(2), minute = clock.part(':', 59);
    auto const then = *day_of(*year, *month, *day) + hours{*hour} + minutes{*minute} - *zone.offset();
    year_month_day const date{floor<days>(then)};
    if (static_cast<int>(date.year()) < 1 || static_cast<int>(date.year()) > 9'999) return std::string{text};
    hh_mm_ss const shown{then - floor<days>(then)};
    std::string utc = "0000-00-00T00:00";
    put_minute(utc, date, shown);
    return utc.append(written.substr(utc.size(), end_of_second - utc.size())).append("Z");
}

std::string in_seconds(nanoseconds time) {
    auto const all = round<milliseconds>(time).count();
    auto text = std::to_string(all / 1'000);
    if (auto const rest = all % 1'000; rest != 0) {
        text += "." + std::to_string(1'000 + rest).substr(1);
        text.resize(text.find_last_not_of('0') + 1);
    }
    return text + " s";
}

// The clock counts nanoseconds, so that all years have four digits.
std::string to_text(Utc time) {
    auto const day = floor<days>(time);
    year_month_day const date{day};
    hh_mm_ss const clock{floor<milliseconds>(time - day)};
    std::string text = "0000-00-00T00:00:00.000Z";
    put_minute(text, date, clock);
    put(text, 18, clock.seconds().count());
    put(text, 22, clock.subseconds().count());
    return text;
}

}  // namespace rois
