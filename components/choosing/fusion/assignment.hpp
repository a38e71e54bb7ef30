// The best pairing of two groups.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace rois::choosing {

// Costs of pairing row r with column c, row by row.
class Costs {
public:
    static constexpr double forbidden = std::numeric_limits<double>::infinity();

    Costs(std::size_t rows, std::size_t columns) : rows_{rows}, columns_{columns}, costs_(rows * columns, forbidden) {}

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    double& at(std::size_t row, std::size_t column) { return costs_[row * columns_ + column]; }
    double at(std::size_t row, std::size_t column) const { return costs_[row * columns_ + column]; }

private:
    std::size_t rows_;
    std::size_t columns_;
    std::vector<double> costs_;
};

// Returns the column of each row, so that the sum of the costs is the smallest possible (the Hungarian algorithm). A row without
// a partner costs nothing, so only pairs with negative costs are made. Time: rows^2 * (rows + columns).
std::vector<std::optional<std::size_t>> best_pairs(Costs const&);

}  // namespace rois::choosing
