#include "fuzz/mutation.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "fuzz/markup.hpp"
#include "fuzz/pieces.hpp"

namespace rois::fuzz {

namespace {

constexpr std::size_t longest = 12'000;  // bytes of a document that is changed further
constexpr std::size_t most_learnt = 400;

// One document that is being changed.
class Change {
public:
    Change(std::string text, std::vector<std::string> const& others, std::mt19937_64& random)
        : text_{std::move(text)}, others_{others}, random_{random}, tags_{tags_of(text_)} {}

    std::string apply();

private:
    std::size_t any(std::size_t below) { return static_cast<std::size_t>(random_() % std::max<std::size_t>(below, 1)); }
    bool one_in(std::size_t n) { return any(n) == 0; }

    template <class Pieces>
    std::string_view any_of(Pieces const& pieces) {
        return pieces[any(pieces.size())];
    }

    std::string part(Range range) const { return text_.substr(range.begin, range.size()); }
    void put(Range range, std::string_view instead) { text_.replace(range.begin, range.size(), instead); }
    void put(std::size_t at, std::string_view what) { text_.insert(std::min(at, text_.size()), what); }

    std::size_t any_start_tag();  // an index; the number of tags when there is none
    // One of these local names, or any when there is none of them.
    template <class Names>
    std::size_t any_start_tag_of(Names const& names);
    std::pair<std::size_t, Range> any_attribute();  // its tag, the number of tags when there is none
    Range any_text();                               // between two tags
    std::size_t any_gap() { return tags_.empty() ? any(text_.size()) : tags_[any(tags_.size())].all.end; }
    void rename(std::size_t tag, std::string_view name);

    void change_a_byte();
    void delete_bytes();
    void insert_a_piece();
    void cut_short();
    void double_an_element();
    void delete_an_element();
    void move_an_element();
    void take_an_element_from_another();
    void exchange_elements();
    void rename_an_element();
    void change_a_prefix();
    void rename_a_prefix_everywhere();
    void double_an_attribute();
    void delete_an_attribute();
    void move_an_attribute();
    void add_an_attribute();
    void change_a_value();
    void change_a_text();
    void change_a_namespace();
    void declare_a_namespace();
    void change_a_type();
    void add_white_space();
    void add_a_comment();
    void write_a_character_as_reference();
    void nest_deeply();
    void repeat_often();
    void lengthen_a_name();
    void change_quotes();
    void push_apart();
    void declare_many_namespaces();

    std::string text_;
    std::vector<std::string> const& others_;
    std::mt19937_64& random_;
    std::vector<Tag> tags_;
};

std::string Change::apply() {
    using Kind = void (Change::*)();
    constexpr std::array<Kind, 38> kinds{
        &Change::change_a_byte, &Change::delete_bytes, &Change::insert_a_piece, &Change::cut_short, &Change::double_an_element,
        &Change::delete_an_element, &Change::move_an_element, &Change::take_an_element_from_another, &Change::exchange_elements,
        &Change::rename_an_element, &Change::change_a_prefix, &Change::rename_a_prefix_everywhere, &Change::double_an_attribute,
        &Change::delete_an_attribute, &Change::move_an_attribute, &Change::add_an_attribute, &Change::change_a_value,
        &Change::change_a_text, &Change::change_a_namespace, &Change::declare_a_namespace, &Change::change_a_type,
        &Change::add_white_space, &Change::add_a_comment, &Change::write_a_character_as_reference, &Change::nest_deeply,
        &Change::repeat_often, &Change::lengthen_a_name, &Change::change_quotes, &Change::push_apart,
        &Change::declare_many_namespaces,
        // What keeps a document near to validity, once more.
        &Change::change_a_value, &Change::change_a_text, &Change::change_a_text, &Change::double_an_element,
        &Change::delete_an_element, &Change::take_an_element_from_another, &Change::exchange_elements, &Change::add_an_attribute};
    (this->*kinds[any(kinds.size())])();
    if (text_.empty()) text_ = "<";
    return std::move(text_);
}

std::size_t Change::any_start_tag() {
    auto const first = any(tags_.size());
    for (std::size_t i = 0; i < tags_.size(); ++i) {
        auto const at = (first + i) % tags_.size();
        if (tags_[at].kind != Tag::Kind::end) return at;
    }
    return tags_.size();
}

template <class Names>
std::size_t Change::any_start_tag_of(Names const& names) {
    auto const first = any(tags_.size());
    for (std::size_t i = 0; i < tags_.size(); ++i) {
        auto const at = (first + i) % tags_.size();
        auto const name = part(tags_[at].name);
        auto const local = std::string_view{name}.substr(name.find(':') + 1);
        if (tags_[at].kind != Tag::Kind::end && std::ranges::find(names, local) != names.end()) return at;
    }
    return any_start_tag();
}

std::pair<std::size_t, Range> Change::any_attribute() {
    auto const first = any(tags_.size());
    for (std::size_t i = 0; i < tags_.size(); ++i) {
        auto const at = (first + i) % tags_.size();
        auto const& attributes = tags_[at].attributes;
        if (!attributes.empty()) return {at, attributes[any(attributes.size())]};
    }
    return {tags_.size(), {}};
}

Range Change::any_text() {
    if (tags_.size() < 2) return {};
    auto at = any(tags_.size() - 1);
    // An element that holds text alone, if there is one near.
    for (std::size_t i = 0; i < 8; ++i, at = (at + 1) % (tags_.size() - 1)) {
        if (tags_[at].kind == Tag::Kind::start && tags_[at].counterpart == at + 1) break;
    }
    return {tags_[at].all.end, tags_[at + 1].all.begin};
}

void Change::rename(std::size_t tag, std::string_view name) {
    auto one = tag, other = tags_[tag].counterpart.value_or(tag);
    if (one < other) std::swap(one, other);  // the later one first, so that the other one stays where it is
    put(tags_[one].name, name);
    if (one != other && !one_in(10)) put(tags_[other].name, name);
}

void Change::change_a_byte() {
    auto& byte = text_[any(text_.size())];
    byte = one_in(2) ? static_cast<char>(any(256)) : any_of(bytes).front();
}

void Change::delete_bytes() { text_.erase(any(text_.size()), 1 + any(one_in(2) ? 3 : 20)); }

void Change::insert_a_piece() { put(one_in(2) ? any_gap() : any(text_.size()), any_of(pieces)); }

void Change::cut_short() {
    if (one_in(4)) text_.resize(any(text_.size()));
}

void Change::double_an_element() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    auto const element = element_of(tags_, tag);
    auto const copy = part(element);
    put(element.end, copy);
}

void Change::delete_an_element() {
    auto const tag = any_start_tag();
    if (tag != tags_.size()) put(element_of(tags_, tag), {});
}

void Change::move_an_element() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    auto const element = element_of(tags_, tag);
    auto const moved = part(element);
    auto const target = any_gap();
    if (target >= element.end) put(target, moved);
    put(element, {});
    if (target <= element.begin) put(target, moved);
}

void Change::take_an_element_from_another() {
    auto const& other = others_[any(others_.size())];
    auto const others = tags_of(other);
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < others.size(); ++i) {
        if (others[i].kind != Tag::Kind::end) candidates.push_back(i);
    }
    if (candidates.empty()) return;
    auto const element = element_of(others, candidates[any(candidates.size())]);
    auto const taken = std::string_view{other}.substr(element.begin, element.size());
    auto const mine = any_start_tag();
    if (mine == tags_.size() || one_in(2)) {
        put(any_gap(), taken);
    } else {
        put(element_of(tags_, mine), taken);
    }
}

void Change::exchange_elements() {
    auto one = any_start_tag(), other = any_start_tag();
    if (one == tags_.size() || one == other) return;
    if (one > other) std::swap(one, other);
    auto const first = element_of(tags_, one), second = element_of(tags_, other);
    if (second.begin < first.end) return;
    auto const moved = part(first);
    auto const instead = part(second);
    put(second, moved);
    put(first, instead);
}

void Change::rename_an_element() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    auto const name = part(tags_[tag].name);
    auto const colon = name.find(':');
    auto const prefix = colon == name.npos ? std::string{} : name.substr(0, colon + 1);
    rename(tag, prefix + std::string{any_of(local_names)});
}

void Change::change_a_prefix() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    auto const name = part(tags_[tag].name);
    auto const colon = name.find(':');
    rename(tag, std::string{any_of(prefixes)} + (colon == name.npos ? name : name.substr(colon + 1)));
}

void Change::rename_a_prefix_everywhere() {
    std::string const from{any_of(prefixes)}, to{any_of(prefixes)};
    if (from.size() < 2 || to.size() < 2) return;
    auto const replace_all = [&](std::string const& old, std::string const& fresh) {
        for (auto at = text_.find(old); at != text_.npos; at = text_.find(old, at + fresh.size())) {
            text_.replace(at, old.size(), fresh);
        }
    };
    replace_all(from, to);
    replace_all("xmlns:" + from.substr(0, from.size() - 1) + "=", "xmlns:" + to.substr(0, to.size() - 1) + "=");
}

void Change::double_an_attribute() {
    auto const [tag, attribute] = any_attribute();
    if (tag == tags_.size()) return;
    auto copy = " " + part(attribute);
    if (auto const colon = copy.find(':'); colon != copy.npos && one_in(2))
        copy = " " + std::string{any_of(prefixes)} + copy.substr(colon + 1);
    put(attribute.end, copy);
}

void Change::delete_an_attribute() {
    auto const [tag, attribute] = any_attribute();
    if (tag != tags_.size()) put({attribute.begin - 1, attribute.end}, {});
}

void Change::move_an_attribute() {
    auto const [tag, attribute] = any_attribute();
    auto const target = any_start_tag();
    if (tag == tags_.size()) return;
    auto const moved = " " + part(attribute);
    if (target > tag) put(tags_[target].name.end, moved);
    if (!one_in(3)) put({attribute.begin - 1, attribute.end}, {});
    if (target < tag) put(tags_[target].name.end, moved);
}

void Change::add_an_attribute() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    std::string added{" "};
    if (one_in(2)) added += any_of(prefixes);
    added.append(any_of(attribute_names)).append("=\"").append(any_of(values)).append("\"");
    put(tags_[tag].name.end, added);
}

void Change::change_a_value() {
    auto const [tag, attribute] = any_attribute();
    if (tag == tags_.size()) return;
    auto const value = value_of(text_, attribute);
    if (one_in(3)) {
        put(value.begin + any(value.size() + 1), any_of(values));
    } else {
        put(value, any_of(values));
    }
}

void Change::change_a_text() {
    auto const range = any_text();
    if (range.end < range.begin) return;
    if (one_in(3)) {
        put(range.begin + any(range.size() + 1), any_of(values));
    } else {
        put(range, any_of(values));
    }
}

void Change::change_a_namespace() {
    auto const at = text_.find("xmlns", any(text_.size()));
    auto const quote = text_.find_first_of("\"'", at);
    if (at == text_.npos || quote == text_.npos) return;
    auto const end = text_.find(text_[quote], quote + 1);
    if (end != text_.npos) put({quote + 1, end}, any_of(namespaces));
}

void Change::declare_a_namespace() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    std::string const prefix{any_of(prefixes)};
    auto const name = prefix.size() < 2 ? std::string{"xmlns"} : "xmlns:" + prefix.substr(0, prefix.size() - 1);
    put(tags_[tag].name.end, " " + name + "='" + std::string{any_of(namespaces)} + "'");
}

void Change::change_a_type() {
    auto const written = text_.find("xsi:type=", any(text_.size()));
    auto const type = std::string{any_of(prefixes)}.append(any_of(type_names));
    if (written != text_.npos && !one_in(3)) {
        auto const quote = written + 9;
        auto const end = quote < text_.size() ? text_.find(text_[quote], quote + 1) : text_.npos;
        if (end != text_.npos) put({quote + 1, end}, type);
        return;
    }
    auto const tag = any_start_tag();
    if (tag != tags_.size()) put(tags_[tag].name.end, " xsi:type=\"" + type + "\"");
}

void Change::add_white_space() {
    auto const at = one_in(2) ? any_gap() : text_.find_first_of("=\"'<>/ :", any(text_.size()));
    put(at == text_.npos ? 0 : at + any(2), any_of(blanks));
}

void Change::add_a_comment() { put(one_in(3) ? any(text_.size()) : any_gap(), any_of(comments)); }

void Change::write_a_character_as_reference() {
    auto const at = any(text_.size());
    auto const code = static_cast<unsigned char>(text_[at]);
    auto const number = std::to_string(code);
    if (code < 0x80) put({at, at + 1}, one_in(2) ? "&#" + number + ";" : std::string{any_of(references)});
}

void Change::nest_deeply() {
    auto const tag = one_in(2) ? any_start_tag_of(nesting_names) : any_start_tag();
    if (tag == tags_.size() || !tags_[tag].counterpart || !one_in(4)) return;
    auto const before = part(tags_[tag].all);
    auto const after = part(tags_[std::max(tag, *tags_[tag].counterpart)].all);
    auto const times = one_in(2) ? any(5) : 50 + any(20);
    auto const element = element_of(tags_, tag);
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += before;
    all += part(element);
    for (std::size_t i = 0; i < times; ++i) all += after;
    put(element, all);
}

void Change::repeat_often() {
    auto const tag = any_start_tag();
    if (tag == tags_.size() || !one_in(8)) return;
    auto const element = element_of(tags_, tag);
    auto const copy = part(element);
    auto const times = one_in(10) && copy.size() < 60 ? 5'200 : any(60);
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += copy;
    put(element.end, all);
}

void Change::lengthen_a_name() {
    auto const tag = any_start_tag();
    if (tag == tags_.size()) return;
    std::string const prefix(one_in(2) ? 240 + any(20) : 1 + any(3), 'p');
    auto const name = part(tags_[tag].name);
    auto const colon = name.find(':');
    auto const local = colon == name.npos ? name : name.substr(colon + 1);
    auto const renamed = prefix + ":" + local;
    put(tags_[tag].name.end, " xmlns:" + prefix + "=\"" + std::string{any_of(namespaces)} + "\"");
    tags_ = tags_of(text_);
    rename(tag, renamed);
}

void Change::change_quotes() {
    auto const [tag, attribute] = any_attribute();
    if (tag == tags_.size()) return;
    auto const value = value_of(text_, attribute);
    auto const other = text_[attribute.end - 1] == '"' ? '\'' : '"';
    text_[value.begin - 1] = text_[value.end] = other;
}

// Far enough for what follows to lie across the edge of a parser's buffer.
void Change::push_apart() {
    if (!one_in(4)) return;
    std::string all;
    auto const filling = any_of(fillings);
    for (auto const size = any(one_in(4) ? 60'000 : 9'000); all.size() < size;) all += filling;
    auto const list = any_start_tag_of(list_names);
    if (list != tags_.size() && one_in(3)) {
        put(tags_[list].all.end, all);
    } else {
        put(one_in(2) ? any_gap() : any_text().begin, all);
    }
}

void Change::declare_many_namespaces() {
    auto const tag = any_start_tag();
    if (tag == tags_.size() || !one_in(6)) return;
    std::string all;
    for (auto count = 20 + any(16); count > 0; --count) {
        all.append(" xmlns:n").append(std::to_string(count)).append("=\"").append(namespaces[3]).append("\"");
    }
    put(tags_[tag].name.end, all);
}

}  // namespace

Mutation::Mutation(std::vector<std::string> samples, std::uint64_t seed)
    : samples_{std::move(samples)}, given_{samples_.size()}, random_{seed} {}

std::string Mutation::next() {
    // Half of them from what was learnt.
    auto const below = random_() % 2 == 0 ? given_ : samples_.size();
    auto text = samples_[static_cast<std::size_t>(random_() % below)];
    auto const changes = std::array<std::size_t, 6>{1, 1, 1, 2, 2, 4}[static_cast<std::size_t>(random_() % 6)];
    for (std::size_t i = 0; i < changes; ++i) text = Change{std::move(text), samples_, random_}.apply();
    return text;
}

void Mutation::learn(std::string document) {
    if (document.size() > longest) return;
    if (samples_.size() < given_ + most_learnt) {
        samples_.push_back(std::move(document));
    } else {
        samples_[given_ + oldest_++ % most_learnt] = std::move(document);
    }
}

}  // namespace rois::fuzz
