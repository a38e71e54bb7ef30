#include "fuzz/change.hpp"

#include "fuzz/pieces.hpp"

namespace rois::fuzz {

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

}  // namespace rois::fuzz
