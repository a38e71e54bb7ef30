// The values in messages: identifiers, parameters, results and located entities (tables 9, 16 to 19; RLS data).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "types/codes.hpp"
#include "types/instant.hpp"

namespace rois {

// RoIS_Identifier (table 9): a code, unique within its codebook. Absent attributes are empty.
struct Identifier {
    std::string code{};
    std::string authority{};
    std::string codebook_ref{};
    std::string version{};

    bool operator==(Identifier const&) const = default;
};

// Parameter (table 16): a named value. `values` holds the texts of the rois:value elements: one for a single value and for a list
// of numbers or bools (separated by spaces), one per item for other lists.
struct Parameter {
    std::string name;
    Identifier data_type_ref;
    std::vector<std::string> values;

    bool operator==(Parameter const&) const = default;
};

using ParameterList = std::vector<Parameter>;  // in the order of the document (tables 17, 18 and 19)

// The pose of one entity in the frame `crs`: position in mm, orientation (roll, pitch, yaw) in degrees counter-clockwise.
struct Located {
    struct Reliability {
        double probability;  // 0 to 1
        bool operator==(Reliability const&) const = default;
    };
    struct Covariance {
        std::vector<double> rows;  // a square matrix, row by row, of position and then orientation, in mm and degrees
        bool operator==(Covariance const&) const = default;
    };

    std::string of;   // name of the result that it belongs to
    std::string ref;  // code of the entity
    std::string crs;
    std::array<double, 3> position{};
    std::vector<double> orientation;  // empty or three
    std::variant<std::monostate, Reliability, Covariance> certainty;

    bool operator==(Located const&) const = default;
};

// ResultList (table 17). Positions are stored twice: as texts in `parameters`, and as structured values in `located`.
struct Results {
    ParameterList parameters;
    std::vector<Located> located;
};

// Returns a vector of one row. An initializer list would copy it.
std::vector<Results> one_row(Results);

// Make parameters with the type codes of the basic profiles, for answers and events.
Parameter integer(std::string name, std::int64_t value);
Parameter boolean(std::string name, bool value);
Parameter text(std::string name, std::string value);
Parameter texts(std::string name, std::vector<std::string> values);
Parameter date_time(std::string name, Utc value);
Parameter status_of(std::string name, ComponentStatus value);
Parameter status_of(std::string name, StreamStatus value);
Parameter reference(std::string name, std::string code, std::string codebook_ref = {});
Parameter references(std::string name, std::vector<std::string> codes, std::string codebook_ref = {});
Parameter positions(std::string name, std::vector<std::string> points, std::string crs);  // each "x, y, th": mm, mm, degrees

// Returns the parameter with this name, ignoring case; null if there is none.
Parameter const* find(std::span<Parameter const> list, std::string_view name);

}  // namespace rois
