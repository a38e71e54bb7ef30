// The parts of the fusion: estimates, tracks, the best pairing, the motion between two series of points.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "choosing/fusion/assignment.hpp"
#include "choosing/fusion/rigid_fit.hpp"
#include "choosing/simulator.hpp"

namespace rois::choosing::stage {
namespace {

Matrix random_covariance(std::mt19937& random) {
    std::normal_distribution<double> normal;
    Matrix m;
    m << normal(random), normal(random), normal(random), normal(random);
    return m * m.transpose() + Matrix::Identity() * 0.05;
}

TEST(CovarianceIntersection, IsNeverTooSureHoweverTheErrorsAreCorrelated) {
    std::mt19937 random{1};
    std::uniform_real_distribution<double> part{-0.99, 0.99};
    for (int i = 0; i < 2000; ++i) {
        Gaussian const a{{0, 0}, random_covariance(random)}, b{{1, 0}, random_covariance(random)};
        Gaussian const c = covariance_intersection(a, b);
        // c = A a + B b, with these errors of a and b.
        Matrix const from_a = [&] {
            Gaussian x{{1, 0}, a.covariance}, y{{0, 1}, a.covariance}, none{{0, 0}, b.covariance};
            Matrix columns;
            columns << covariance_intersection(x, none).mean, covariance_intersection(y, none).mean;
            return columns;
        }();
        Matrix const from_b = Matrix::Identity() - from_a;
        Matrix const root_a = a.covariance.llt().matrixL(), root_b = b.covariance.llt().matrixL();
        Matrix const cross =
            root_a * (Eigen::Rotation2Dd{i * 0.1} * Matrix{Matrix::Identity() * part(random)}) * root_b.transpose();
        Matrix const actual = from_a * a.covariance * from_a.transpose() + from_b * b.covariance * from_b.transpose() +
                              from_a * cross * from_b.transpose() + from_b * cross.transpose() * from_a.transpose();
        Matrix const margin = c.covariance - actual;
        EXPECT_GT(margin.trace(), -1e-9);
        EXPECT_GT(margin.determinant(), -1e-9);
    }
}

TEST(CovarianceIntersection, IsInTheMiddleOfEquallyCertainPositions) {
    Gaussian const a{{0, 0}, Matrix::Identity()}, b{{1, 0}, Matrix::Identity()};
    EXPECT_NEAR(covariance_intersection(a, b).mean.x(), 0.5, 1e-12);
    EXPECT_NEAR(covariance_intersection(a, b, 0.75).mean.x(), 0.25, 1e-12);
    Gaussian const slightly_better{{0, 0}, Matrix::Identity() * 0.99};
    EXPECT_NEAR(covariance_intersection(slightly_better, b).mean.x(), 0.5, 0.02) << "no jumps";
}

TEST(CovarianceIntersection, NearlyIgnoresAPositionThatIsMuchLessCertain) {
    Gaussian const a{{0, 0}, Matrix::Identity() * 0.01}, b{{1, 0}, Matrix::Identity()};
    for (auto const& c : {covariance_intersection(a, b), covariance_intersection(b, a)}) {
        EXPECT_LT(c.mean.x(), 0.001);
        EXPECT_LT(c.covariance(0, 0), 0.0102);
    }
}

TEST(CovarianceIntersection, TakesTheBetterDirectionOfEach) {
    Gaussian a, b;
    a.covariance << 0.01, 0, 0, 1;
    b.covariance << 1, 0, 0, 0.01;
    Matrix const c = covariance_intersection(a, b).covariance;
    EXPECT_LT(c(0, 0), 0.03);
    EXPECT_LT(c(1, 1), 0.03);
}

TEST(BestPairs, HaveTheSmallestSumOfAllPairings) {
    std::mt19937 random{1};
    std::uniform_real_distribution<double> cost{-10, 3};
    for (int run = 0; run < 300; ++run) {
        std::size_t const rows = 1 + random() % 4, columns = 1 + random() % 4;
        Costs costs{rows, columns};
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < columns; ++c)
                if (random() % 4 != 0) costs.at(r, c) = cost(random);
        double sum = 0;
        auto const pairs = best_pairs(costs);
        for (std::size_t r = 0; r < rows; ++r)
            if (pairs[r]) sum += costs.at(r, *pairs[r]);
        // Tries all orders of the columns; those behind the last one mean "no partner".
        std::vector<std::size_t> order(columns + rows);
        std::iota(order.begin(), order.end(), 0);
        double best = 0;
        do {
            double total = 0;
            for (std::size_t r = 0; r < rows; ++r)
                if (order[r] < columns) total += std::min(costs.at(r, order[r]), 1e6);
            best = std::min(best, total);
            std::ranges::reverse(order.begin() + static_cast<std::ptrdiff_t>(rows), order.end());
        } while (std::ranges::next_permutation(order).found);
        EXPECT_NEAR(sum, best, 1e-6);
    }
}

TEST(BestPairs, OfNobodyAreNone) {
    EXPECT_TRUE(best_pairs(Costs{0, 3}).empty());
    EXPECT_EQ(best_pairs(Costs{2, 0}).size(), 2u);
}

TEST(RigidSums, FindTheRotationAndShift) {
    RigidSums sums;
    Rigid const motion{0.3, {1, -2}};
    for (double x : {0.0, 1.0, 2.0, 5.0}) sums.add({x, x * x}, motion(Vector{x, x * x}), 2);
    EXPECT_NEAR(sums.fit().turn, 0.3, 1e-9);
    EXPECT_LT((sums.fit().shift - motion.shift).norm(), 1e-9);
    EXPECT_NEAR(sums.error(motion), 0, 1e-9);
    EXPECT_NEAR(sums.error({0.3, {1, -1}}), 1, 1e-9);
}

TEST(ATrack, FollowsAWalkingPersonBetweenTheLists) {
    Track track{1, 0, "p", {}, {{{0, 0}, Matrix::Identity() * 0.0025}}, after(0)};
    for (int i = 1; i <= 20; ++i) track.measure({{{i * 0.3, 0}, Matrix::Identity() * 0.0025}}, after(i * 0.2));
    EXPECT_NEAR(track.at(after(4.4)).position.mean.x(), 6.6, 0.05);
    EXPECT_NEAR(track.at(after(4)).velocity.mean.x(), 1.5, 0.05);
}

TEST(ATrack, IsNeverMoreCertainThanItsUnit) {
    Matrix const covariance = Matrix::Identity() * 0.0025;
    Track track{1, 0, "p", {}, {{{0, 0}, covariance}}, after(0)};
    for (int i = 1; i <= 100; ++i) track.measure({{{0, 0}, covariance}}, after(i * 0.05));
    EXPECT_NEAR(track.at(after(5)).position.covariance(0, 0), 0.0025, 1e-9);
    EXPECT_GT(track.at(after(6)).position.covariance(0, 0), 0.05) << "a second later the person may be elsewhere";
}

TEST(ATrack, StandsWhereItWasLastSeenWhenTheUnitIsSilent) {
    UnitSettings const settings{.period = std::chrono::milliseconds{500}};
    Track track{1, 0, "p", settings, {{{0, 0}, Matrix::Identity() * 0.0025}}, after(0)};
    for (int i = 1; i <= 20; ++i) track.measure({{{i * 0.3, 0}, Matrix::Identity() * 0.0025}}, after(i * 0.2));
    EXPECT_NEAR(track.at(after(9)).position.mean.x(), 6, 0.05);
    EXPECT_NEAR(track.at(after(9)).position.covariance(0, 0), 0.0125, 0.0005);
}

// Random lists: persons at random places, with random names, covariances, times and units.
TEST(RandomLists, NeverBreakTheRules) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::mt19937 random{seed};
        auto const number = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
        Fusion fusion;
        std::set<std::string> known;
        for (int i = 0; i < 400; ++i) {
            auto const when = after(i * 0.1 + number(10) * 0.03);
            std::string const unit = "unit" + std::to_string(number(4));
            std::vector<Sighting> list;
            for (int n = number(8); n > 0; --n) {
                Matrix covariance = random_covariance(random) * (number(3) * 0.05);
                list.push_back({"p" + std::to_string(number(6)), Vector{number(8), number(4)} * 0.3, {}, covariance});
            }
            if (number(30) == 0) fusion.lost(unit, when);
            fusion.sensed(unit, when, list);
            for (auto const& change : fusion.take_changes()) {
                bool const appeared = change.kind == Change::Kind::appeared;
                EXPECT_TRUE(appeared ? known.insert(change.name).second : known.erase(change.name) == 1);
                EXPECT_TRUE(change.merged_into.empty() || known.contains(change.merged_into));
            }
            auto const persons = fusion.persons(when);
            EXPECT_EQ(persons.size(), known.size());
            for (FusedPerson const& person : persons) {
                EXPECT_TRUE(known.contains(person.name));
                EXPECT_TRUE(is_covariance(person.covariance));
                EXPECT_TRUE(person.position.allFinite());
                std::set<std::string> units;
                for (auto const& [by, name] : person.sensed_by) {
                    EXPECT_TRUE(units.insert(by).second) << "one unit never lists a person twice";
                    EXPECT_EQ(fusion.own_name(by, name), person.name);
                    EXPECT_EQ(fusion.unit_name(person.name, by), name);
                }
            }
        }
    }
}

}  // namespace
}  // namespace rois::choosing::stage
