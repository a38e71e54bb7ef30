#include "choosing/fusion/assignment.hpp"

#include <algorithm>

namespace rois::choosing {
namespace {

constexpr double very_high = 1e9;

// The Hungarian algorithm with potentials. Rows and columns count from 1; row 0 means "none". Behind the given columns, each row
// has a column of its own that stands for "no partner".
class Hungarian {
public:
    explicit Hungarian(Costs const& costs)
        : costs_{costs},
          columns_{costs.columns() + costs.rows()},
          row_potential_(costs.rows() + 1),
          column_potential_(columns_ + 1),
          row_of_(columns_ + 1) {
        for (std::size_t row = 1; row <= costs.rows(); ++row) add(row);
    }

    std::vector<std::size_t> const& row_of() const { return row_of_; }

private:
    double cost(std::size_t row, std::size_t column) const {
        if (column > costs_.columns()) return column - costs_.columns() == row ? 0 : very_high;
        return std::min(costs_.at(row - 1, column - 1), very_high);
    }

    // Finds the cheapest chain of changes that ends at a free column, and makes these changes.
    void add(std::size_t row) {
        std::vector<double> slack(columns_ + 1, Costs::forbidden);
        std::vector<std::size_t> before(columns_ + 1);
        std::vector<bool> used(columns_ + 1);
        row_of_[0] = row;
        std::size_t column = 0;
        while (row_of_[column] != 0) column = next(column, slack, before, used);
        for (; column != 0; column = before[column]) row_of_[column] = row_of_[before[column]];
    }

    std::size_t next(std::size_t column, std::vector<double>& slack, std::vector<std::size_t>& before, std::vector<bool>& used) {
        used[column] = true;
        std::size_t const row = row_of_[column];
        std::size_t nearest = 0;
        double smallest = Costs::forbidden;
        for (std::size_t c = 1; c <= columns_; ++c) {
            if (used[c]) continue;
            double const reduced = cost(row, c) - row_potential_[row] - column_potential_[c];
            if (reduced < slack[c]) {
                slack[c] = reduced;
                before[c] = column;
            }
            if (slack[c] < smallest) {
                smallest = slack[c];
                nearest = c;
            }
        }
        for (std::size_t c = 0; c <= columns_; ++c) {
            if (used[c]) {
                row_potential_[row_of_[c]] += smallest;
                column_potential_[c] -= smallest;
            } else {
                slack[c] -= smallest;
            }
        }
        return nearest;
    }

    Costs const& costs_;
    std::size_t columns_;
    std::vector<double> row_potential_;
    std::vector<double> column_potential_;
    std::vector<std::size_t> row_of_;
};

}  // namespace

std::vector<std::optional<std::size_t>> best_pairs(Costs const& costs) {
    std::vector<std::optional<std::size_t>> pairs(costs.rows());
    Hungarian const solved{costs};
    for (std::size_t column = 1; column <= costs.columns(); ++column) {
        std::size_t const row = solved.row_of()[column];
        if (row != 0 && costs.at(row - 1, column - 1) < 0) pairs[row - 1] = column - 1;
    }
    return pairs;
}

}  // namespace rois::choosing
