#include "engine/conditions/value_path.hpp"

#include <charconv>

#include "types/text/texts.hpp"

namespace rois {

namespace {

constexpr std::string_view white_space = " \t\r\n";

bool may_be_in_a_name(char c) {
    bool const letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    return letter || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

class PathParser {
public:
    explicit PathParser(std::string_view text) : rest_{text} {}

    bool at_end() const { return rest_.empty(); }

    bool take(char expected) {
        skip_blanks();
        if (!rest_.starts_with(expected)) return false;
        rest_.remove_prefix(1);
        skip_blanks();
        return true;
    }

    // A name without its prefix; nullopt for "." and "..".
    std::optional<std::string_view> name() {
        auto local = plain_name();
        if (local && rest_.starts_with(':')) {
            rest_.remove_prefix(1);
            local = plain_name();
        }
        return local;
    }

    // "[2]" or "[@name='volume']", after the opening bracket.
    bool predicate(PathStep& step) {
        if (!take('@')) return position(step) && take(']');
        auto attribute = name();
        if (!attribute || !take('=')) return false;
        auto text = quoted_text();
        if (!text || !take(']')) return false;
        step.predicates.push_back({*attribute, *text});
        return true;
    }

private:
    void skip_blanks() {
        auto const first = rest_.find_first_not_of(white_space);
        rest_.remove_prefix(first == std::string_view::npos ? rest_.size() : first);
    }

    std::optional<std::string_view> plain_name() {
        std::size_t length = 0;
        while (length < rest_.size() && may_be_in_a_name(rest_[length])) ++length;
        bool const begins_well = length > 0 && std::string_view{".-0123456789"}.find(rest_[0]) == std::string_view::npos;
        if (!begins_well) return {};
        auto const name = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return name;
    }

    bool position(PathStep& step) {
        if (step.position != 0) return false;
        auto const [end, problem] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), step.position);
        if (problem != std::errc{} || step.position == 0) return false;
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return true;
    }

    std::optional<std::string_view> quoted_text() {
        if (rest_.empty() || (rest_.front() != '\'' && rest_.front() != '"')) return {};
        auto const end = rest_.find(rest_.front(), 1);
        if (end == std::string_view::npos) return {};
        auto const text = rest_.substr(1, end - 1);
        rest_.remove_prefix(end + 1);
        return text;
    }

    std::string_view rest_;
};

}  // namespace

std::optional<ValuePath> ValuePath::parse(std::string_view text) {
    PathParser reader{trimmed(text)};
    ValuePath path;
    do {
        if (reader.take('@')) {
            auto attribute = reader.name();
            if (!attribute || path.steps.empty() || !reader.at_end()) return {};
            path.attribute = *attribute;
            return path;
        }
        auto name = reader.name();
        if (!name) return {};
        auto& step = path.steps.emplace_back();
        step.name = *name;
        while (reader.take('['))
            if (!reader.predicate(step)) return {};
    } while (reader.take('/'));
    if (!reader.at_end()) return {};
    return path;
}

}  // namespace rois
