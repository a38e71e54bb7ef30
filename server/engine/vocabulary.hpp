// What the value references of a condition may speak of (decision 18; docs/conditions.md).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/places.hpp"
#include "types/profiles.hpp"

namespace rois {

// How values are compared. `any`: as what both sides look like. `name`: a text without regard to case.
enum class ValueKind : std::uint8_t { any, number, time, boolean, text, name };

// A text as it is compared without regard to case.
std::string folded_name(std::string_view);

// A value reference, resolved.
struct Reference {
    enum class To : std::uint8_t {
        component_ref,
        component_type,
        engine,
        robot_id,
        status,
        bound,
        location,
        parameter,
        result,
        located  // all located entities of the results
    };
    enum class Part : std::uint8_t { value, code, authority, codebook_ref, version, name, data_type_ref, ref, crs };
    enum class Items : std::uint8_t { one_each, packed };  // a list of numbers or bools is packed into one text
    static constexpr std::size_t no_alias = SIZE_MAX;

    To to = To::component_ref;
    std::string name;          // of the parameter or result, or of the result that is located; in lower case
    std::string entity;        // only what is located with this ref; empty: all
    std::size_t position = 0;  // only the value at this place, from 1; 0: all
    Part part = Part::value;   // or an attribute of it
    ValueKind kind = ValueKind::any;
    Items items = Items::one_each;
    std::size_t alias = no_alias;  // of the types of the group, counted from 0
};

// The same text for references that mean the same.
std::string canonical(Reference const&);

// Parameters or results by name, without regard to case, with the types that their profiles declare.
class Declarations {
public:
    struct Declared {
        std::string name;
        ValueKind kind = ValueKind::any;
        Reference::Items items = Reference::Items::one_each;
    };

    // A name that is declared with two types is taken for any of them.
    void add(ParameterProfile const&);
    void add(std::span<ParameterProfile const> profiles) {
        for (auto const& profile : profiles) add(profile);
    }

    // Null when it is not declared; other versions' spellings are known.
    Declared const* find(std::string_view name) const;

    bool empty() const { return by_name_.empty(); }
    auto begin() const { return by_name_.begin(); }
    auto end() const { return by_name_.end(); }

private:
    std::map<std::string, Declared, std::less<>> by_name_;
};

// `parameters`: of components, null where a condition does not speak of components. `results`: null where it does not speak of
// any. `first`: which of both a bare name means that both have, and an operator of space with one operand. What it points to must
// live as long, and the places as long as what is compiled with it.
struct Vocabulary {
    enum class First : std::uint8_t { results, parameters };

    Places const* places = nullptr;
    Declarations const* parameters = nullptr;
    Declarations const* results = nullptr;
    First first = First::results;
    std::string_view main_engine{};  // the name of the engine that has all components and sub engines

    // The reference, or why there is none. An alias is the first of several steps.
    std::variant<Reference, std::string> resolve(std::string_view path, std::span<std::string const> aliases = {}) const;

    // What a spatial or temporal operator with one operand is about: a value reference; empty when there is nothing.
    std::string_view own_position() const;
    std::string_view own_time() const;

    // All that may be referred to, for people.
    std::string known() const;
};

}  // namespace rois
