#include "engine/conditions/filter.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/conditions/candidate.hpp"
#include "engine/conditions/filter_compiler.hpp"
#include "engine/conditions/referred.hpp"
#include "types/data_type.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// A list among the results.
struct List {
    std::size_t at;  // its index among the parameters
    Reference::Items kept;
    Texts items;
};

std::optional<List> list_at(ParameterList const& parameters, std::size_t at) {
    auto const type = DataType::of(parameters[at].data_type_ref);
    if (!type.list) return {};
    bool const packed = type.base == BaseType::integer || type.base == BaseType::real || type.base == BaseType::boolean;
    auto const kept = packed ? Reference::Items::packed : Reference::Items::one_each;
    return List{at, kept, items_of(parameters[at], kept)};
}

std::vector<std::string> values_of(Texts items, Reference::Items kept) {
    if (kept == Reference::Items::one_each || items.empty()) return items;
    std::string packed;
    for (auto const& item : items) packed.append(packed.empty() ? "" : " ").append(item);
    return {std::move(packed)};
}

// Parallel lists.
struct Table {
    std::vector<List> lists;
    std::vector<std::optional<std::size_t>> entry_of_located;  // for each `located` element of the results
    std::vector<std::vector<std::size_t>> located_of_entry;    // the inverse

    std::size_t length() const { return lists.front().items.size(); }
};

bool has_list(Table const& table, ParameterList const& parameters, std::string_view name) {
    return std::ranges::any_of(table.lists,
                               [&](List const& list) { return equal_ignoring_case(parameters[list.at].name, name); });
}

// Returns the index of the code in a list of identifiers.
std::optional<std::size_t> entry_with(Table const& table, ParameterList const& parameters, std::string_view code) {
    for (auto const& list : table.lists) {
        if (DataType::of(parameters[list.at].data_type_ref).base != BaseType::identifier) continue;
        auto const found = std::ranges::find(list.items, code);
        if (found != list.items.end()) return static_cast<std::size_t>(found - list.items.begin());
    }
    return {};
}

// A `located` element belongs to the entry with its index if every entry has one element, or else to the entry that has its ref.
void assign_located(Table& table, Results const& results) {
    std::map<std::string, std::vector<std::size_t>> located_of_list;
    for (std::size_t i = 0; i < results.located.size(); ++i)
        if (has_list(table, results.parameters, results.located[i].of))
            located_of_list[lower_case(results.located[i].of)].push_back(i);
    table.entry_of_located.resize(results.located.size());
    table.located_of_entry.resize(table.length());
    for (auto const& [of, all] : located_of_list) {
        for (std::size_t k = 0; k < all.size(); ++k) {
            auto const entry = all.size() == table.length() ? std::optional{k}
                                                            : entry_with(table, results.parameters, results.located[all[k]].ref);
            table.entry_of_located[all[k]] = entry;
            if (entry) table.located_of_entry[*entry].push_back(all[k]);
        }
    }
}

// Returns whether the reference is about the entries of this list.
bool is_about(Reference const& reference, Parameter const& parameter, std::vector<Located> const& located) {
    if (reference.to == Reference::To::result)
        return reference.part == Reference::Part::value && equal_ignoring_case(reference.name, parameter.name);
    if (!reference.name.empty()) return equal_ignoring_case(reference.name, parameter.name);
    return std::ranges::any_of(located, [&](Located const& each) { return equal_ignoring_case(each.of, parameter.name); });
}

// Results in which each parallel list is reduced to one entry. An index in a reference, such as "person_ref[2]", still counts in
// the whole list.
class EntryCandidate final : public Candidate {
public:
    EntryCandidate(Results const& row, std::string_view id, Table const& table) : row_{row}, whole_{row, id}, table_{table} {}

    std::size_t entry = 0;  // the entry that the row contains

    std::optional<Texts> texts(Reference const& reference) const override {
        if (!names_a_place(reference)) return whole_.texts(reference);
        return reference.position == entry + 1 ? whole_.texts(without_place(reference)) : Texts{};
    }
    std::optional<Positions> positions(Reference const& reference) const override {
        if (!names_a_place(reference)) return whole_.positions(reference);
        return reference.position == entry + 1 ? whole_.positions(without_place(reference)) : Positions{};
    }
    bool has(Reference const& reference) const override { return whole_.has(reference); }
    std::string_view rid() const override { return whole_.rid(); }
    std::vector<Candidate const*> robot() const override { return {}; }
    std::optional<GroupVerdict>* verdict(void const*) const override { return nullptr; }

private:
    bool names_a_place(Reference const& reference) const {
        return reference.position != 0 && speaks_of_results(reference) &&
               (reference.name.empty() || has_list(table_, row_.parameters, reference.name));
    }
    static Reference without_place(Reference reference) {
        reference.position = 0;
        return reference;
    }

    Results const& row_;
    ResultsCandidate whole_;
    Table const& table_;
};

// Returns for each entry whether it matches.
std::vector<bool> matching(Table const& table, Results const& results, Filter const& filter, std::string_view id) {
    auto row = results;
    std::erase_if(row.located, [&](Located const& each) { return has_list(table, results.parameters, each.of); });
    auto const others = row.located.size();
    std::vector<bool> matches(table.length());
    EntryCandidate candidate{row, id, table};
    for (auto& entry = candidate.entry; entry < table.length(); ++entry) {
        for (auto const& list : table.lists) row.parameters[list.at].values = {list.items[entry]};
        row.located.resize(others);
        for (auto const i : table.located_of_entry[entry]) row.located.push_back(results.located[i]);
        Effort::spend(20 * table.lists.size());
        matches[entry] = filter.match(candidate) == Match::yes;
    }
    return matches;
}

// Returns the tables that the filter refers to; nullopt if it refers to no list.
std::optional<std::vector<Table>> tables_of(Results const& results, Filter const& filter) {
    std::map<std::size_t, Table> by_length;
    std::set<std::size_t> referred;
    for (std::size_t at = 0; at < results.parameters.size(); ++at) {
        auto list = list_at(results.parameters, at);
        if (!list) continue;
        auto const length = list->items.size();
        by_length[length].lists.push_back(std::move(*list));
        auto const is_meant = [&](Reference const& reference) {
            return is_about(reference, results.parameters[at], results.located);
        };
        if (std::ranges::any_of(filter.results(), is_meant)) referred.insert(length);
    }
    if (referred.empty()) return {};
    std::vector<Table> tables;
    for (auto& [length, table] : by_length) {
        if (length == 0 || !referred.contains(length)) continue;
        assign_located(table, results);
        tables.push_back(std::move(table));
    }
    return tables;
}

void keep(Table& table, std::vector<bool> const& matches, Results& results) {
    for (auto& list : table.lists) {
        Texts kept;
        for (std::size_t entry = 0; entry < matches.size(); ++entry)
            if (matches[entry]) kept.push_back(std::move(list.items[entry]));
        results.parameters[list.at].values = values_of(std::move(kept), list.kept);
    }
}

bool stays(Located const& located, std::size_t at, Table const& table, std::vector<bool> const& matches,
           ParameterList const& parameters) {
    if (!has_list(table, parameters, located.of)) return true;
    auto const& entry = table.entry_of_located[at];
    return entry && matches[*entry];
}

}  // namespace

void keep_matching(Results& results, Filter const& filter, std::string_view id) {
    auto tables = tables_of(results, filter);
    if (!tables) {
        if (filter.match(ResultsCandidate{results, id}) != Match::yes) results = {};
        return;
    }
    std::vector<std::vector<bool>> matches;
    for (auto const& table : *tables) {
        // Each entry is compared with all entries of the lists of other lengths.
        bool const too_many = std::ranges::any_of(*tables, [&](Table const& other) {
            return &other != &table && make_too_many_pairs(table.lists.front().items, other.lists.front().items);
        });
        matches.push_back(too_many ? std::vector<bool>(table.length()) : matching(table, results, filter, id));
    }
    std::vector<Located> located;
    for (std::size_t i = 0; i < results.located.size(); ++i) {
        bool stays_here = true;
        for (std::size_t t = 0; t < tables->size(); ++t)
            stays_here = stays_here && stays(results.located[i], i, (*tables)[t], matches[t], results.parameters);
        if (stays_here) located.push_back(std::move(results.located[i]));
    }
    results.located = std::move(located);
    for (std::size_t t = 0; t < tables->size(); ++t) keep((*tables)[t], matches[t], results);
}

}  // namespace rois
