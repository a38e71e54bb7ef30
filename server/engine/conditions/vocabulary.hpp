// The names that a condition's value references can use (decision 18; docs/conditions.md).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "engine/frames/places.hpp"
#include "types/profiles.hpp"

namespace rois {

// The type by which values are compared. `any`: the type that both texts can be read as. `name`: text, without regard to case.
enum class ValueKind : std::uint8_t { any, number, time, boolean, text, name };

// Returns the text folded for comparison without regard to case.
std::string folded_name(std::string_view);

// A resolved value reference.
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
        located  // all located entities among the results
    };
    enum class Part : std::uint8_t { value, code, authority, codebook_ref, version, name, data_type_ref, ref, crs };
    enum class Items : std::uint8_t { one_each, packed };  // a list of numbers or bools is packed into one text
    static constexpr std::size_t no_alias = SIZE_MAX;

    To to = To::component_ref;
    std::string name;          // of the parameter or result, or of the result that the entity is located in; in lower case
    std::string entity;        // only the entity with this ref; empty: all
    std::size_t position = 0;  // only the value at this place, counted from 1; 0: all
    Part part = Part::value;   // the value or one of its attributes
    ValueKind kind = ValueKind::any;
    Items items = Items::one_each;
    std::size_t alias = no_alias;  // index among the types of the group
};

// Returns the same text for equivalent references.
std::string canonical(Reference const&);

// Parameters or results by name, without regard to case, with their declared types.
class Declarations {
public:
    struct Declared {
        std::string name;
        ValueKind kind = ValueKind::any;
        Reference::Items items = Reference::Items::one_each;
    };

    // Declares a name. A name with two different types gets ValueKind::any.
    void add(ParameterProfile const&);
    void add(std::span<ParameterProfile const> profiles) {
        for (auto const& profile : profiles) add(profile);
    }

    // Finds a declaration, also by the spellings of other versions. Returns null if there is none.
    Declared const* find(std::string_view name) const;

    bool empty() const { return by_name_.empty(); }
    auto begin() const { return by_name_.begin(); }
    auto end() const { return by_name_.end(); }

private:
    std::map<std::string, Declared, std::less<>> by_name_;
};

// `parameters`: those of components; null if the condition is not about components. `results`: null if it is not about results.
// `first`: the meaning of a bare name that both have, and of a spatial operator with one operand. The pointers must outlive the
// vocabulary, and `places` the compiled filters too.
struct Vocabulary {
    enum class First : std::uint8_t { results, parameters };

    Places const* places = nullptr;
    Places const* seen_places = nullptr;  // those that the client may name; null: all
    Declarations const* parameters = nullptr;
    Declarations const* results = nullptr;
    First first = First::results;
    std::string_view main_engine{};  // name of the engine that has all components and sub engines

    Places const& places_to_name() const { return seen_places == nullptr ? *places : *seen_places; }

    // Returns the reference, or why the path is invalid. An alias is the first of several steps.
    std::variant<Reference, std::string> resolve(std::string_view path, std::span<std::string const> aliases = {}) const;

    // The reference that a spatial or temporal operator compares if it has one operand only; empty if there is none.
    std::string_view own_position() const;
    std::string_view own_time() const;

    // Lists all names of the vocabulary, for error messages.
    std::string known() const;
};

}  // namespace rois
