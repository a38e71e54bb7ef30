// Finds units whose placement in the main engine's frame is wrong.
//
// Two units that sense the same person should see them at the same place. For each pair of units, the persons whom both sense are
// cut into pieces of some seconds. Each piece votes for the rotations and shifts between the two units that explain it. Without a
// clear majority for a displacement, the units count as well placed.
//
// A badly placed unit's persons never lie near enough to be merged. So two unmerged persons also vote, if they move exactly
// alike: the same path, rotated and shifted. Such a pair may be two persons who walk side by side. So the same displacement must
// be seen with several pairs of persons, or with one pair in several directions.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "choosing/fusion/rigid_fit.hpp"
#include "choosing/fusion/track.hpp"

namespace rois::choosing {

// How far the placements of two units differ.
struct Displacement {
    double distance = 0;  // root mean square over the persons, in metres
    double turn = 0;      // of the persons, counter-clockwise, in radians; of the second unit against the first
};

// Not thread-safe.
class PlacementCheck {
public:
    enum class Relation : std::uint8_t { merged, unmerged };

    // Whether the persons of two units lie near enough for compare().
    static bool is_near(Track const&, Track const&);

    // Two units sense persons at the same time who are the same (`merged`), or who are not known to be the same. Units are
    // different; call it with the smaller unit first. Call it a few times per second.
    void compare(Track const& first, Track const& second, Relation, Steady when);

    // Evaluates the comparisons so far. Call it about once per second.
    void judge(Steady when);

    // Forgets a unit, because it has been lost: it may stand elsewhere when it comes back.
    void forget(int unit);

    // Returns the displacement of a unit against most of the units that sense the same persons; nothing if it is well placed or
    // if this is unknown. Of two units, both are displaced against each other.
    std::optional<Displacement> displaced(int unit) const;

    // The units that were compared with this unit.
    std::vector<int> compared_with(int unit) const;

private:
    // A piece of the common path of two tracks.
    struct Piece {
        RigidSums sums;
        Matrix covariance = Matrix::Zero();  // weighted sum of the covariances of the differences
        int samples = 0;
        Relation relation = Relation::merged;
        Steady began{};
        Steady last{};
        std::pair<std::uint64_t, std::uint64_t> tracks{};
        int direction = 0;  // quadrant of the walk; -1 while standing

        Matrix mean_covariance() const { return covariance / sums.weight(); }
        double variance() const { return mean_covariance().trace() / 2; }
    };
    enum class Verdict : std::uint8_t { unknown, right, wrong };
    struct UnitPair {
        std::map<std::pair<std::uint64_t, std::uint64_t>, Piece> open;
        std::deque<Piece> votes;  // oldest first
        Verdict verdict = Verdict::unknown;
        Displacement displacement;
    };
    // Whether a piece that has ended says something about the placement.
    static bool is_vote(Piece const&);

    // A vote, prepared for counting: agrees with a motion that brings x within the square root of `limit` of y. Votes of the same
    // tracks, in the same direction, have the same voter.
    struct Vote {
        Vector x;
        Vector y;
        double limit;
        std::size_t voter;
    };
    static std::vector<Vote> prepared(std::deque<Piece> const&);
    static std::size_t support(std::vector<Vote> const&, Rigid const&);
    static std::optional<Rigid> winner(std::deque<Piece> const&);
    static void judge(UnitPair&, Steady when);

    std::map<std::pair<int, int>, UnitPair> pairs_;
};

}  // namespace rois::choosing
