#include "choosing/fusion/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rois::choosing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr auto piece_length = seconds{4};
constexpr auto longest_gap = milliseconds{1500};  // between two comparisons of one piece
constexpr auto vote_memory = seconds{40};
constexpr std::size_t most_votes = 80;  // per pair of units
constexpr std::size_t most_open = 400;  // per pair of units
constexpr int least_samples = 8;        // per piece
constexpr double walk_spread = 0.5;     // m^2; of a piece that counts as a walk: a straight path of 2.4 m
constexpr double farthest = 4;          // metres; larger displacements are not found
constexpr double largest_turn = std::numbers::pi / 4;
constexpr std::size_t least_support = 3;  // votes of different persons or directions
constexpr double wrong_beyond = 3.5;      // standard deviations
constexpr double right_within = 2.5;
constexpr double agreement = 3;           // standard deviations within which a piece agrees with a displacement
constexpr double least_deviation = 0.03;  // metres; the errors of a piece's mean are never assumed to be smaller

constexpr int standing = -1;

// Returns 0 to 3 for a direction.
int quadrant(Vector const& direction) { return (direction.x() < 0 ? 1 : 0) + (direction.y() < 0 ? 2 : 0); }

}  // namespace

bool PlacementCheck::is_near(Track const& one, Track const& other) {
    return (one.now.position.mean - other.now.position.mean).squaredNorm() <= farthest * farthest;
}

void PlacementCheck::compare(Track const& first, Track const& second, Relation relation, Steady when) {
    Vector const x = first.now.position.mean;
    Vector const y = second.now.position.mean;
    UnitPair& units = pairs_[{first.unit(), second.unit()}];
    std::pair const tracks{first.id(), second.id()};
    auto found = units.open.find(tracks);
    if (found == units.open.end()) {
        if (units.open.size() >= most_open) return;
        found = units.open.emplace(tracks, Piece{}).first;
    }
    Piece& piece = found->second;
    if (piece.samples == 0 || piece.relation != relation || when - piece.last > longest_gap) {
        piece = {};
        piece.relation = relation;
        piece.began = when;
        piece.tracks = tracks;
    }
    piece.last = when;
    // A position counts most just after it was measured, when it is most certain.
    Matrix const covariance = first.now.position.covariance + second.now.position.covariance;
    double const weight = 1 / covariance.trace();
    piece.sums.add(x, y, weight);
    piece.covariance += weight * covariance;
    ++piece.samples;
    piece.direction = piece.sums.spread() < walk_spread ? standing : quadrant(x - piece.sums.mean_x());
}

bool PlacementCheck::is_vote(Piece const& piece) {
    if (piece.samples < least_samples) return false;
    if (piece.relation == Relation::merged) return true;
    if (piece.sums.spread() < walk_spread) return false;
    Rigid const motion = piece.sums.fit();
    return std::abs(motion.turn) <= largest_turn && piece.sums.error(motion) <= 2 * piece.variance();
}

std::vector<PlacementCheck::Vote> PlacementCheck::prepared(std::deque<Piece> const& pieces) {
    std::map<std::pair<std::pair<std::uint64_t, std::uint64_t>, int>, std::size_t> voters;
    std::vector<Vote> votes;
    for (Piece const& piece : pieces) {
        double const limit = agreement * agreement * std::max(piece.variance(), least_deviation * least_deviation);
        std::size_t const voter = voters.emplace(std::pair{piece.tracks, piece.direction}, voters.size()).first->second;
        votes.push_back({piece.sums.mean_x(), piece.sums.mean_y(), limit, voter});
    }
    return votes;
}

// Returns how many voters agree.
std::size_t PlacementCheck::support(std::vector<Vote> const& votes, Rigid const& motion) {
    std::vector<bool> agrees(votes.size());
    Matrix const rotation = motion.rotation();
    for (auto const& [x, y, limit, voter] : votes)
        if ((y - rotation * x - motion.shift).squaredNorm() <= limit) agrees[voter] = true;
    return static_cast<std::size_t>(std::ranges::count(agrees, true));
}

// Returns the motion that most voters agree with, fitted to all of them. If it has no more support than the supposed placement,
// the latter wins.
std::optional<Rigid> PlacementCheck::winner(std::deque<Piece> const& pieces) {
    auto const votes = prepared(pieces);
    Rigid best;
    std::size_t most = support(votes, best);
    for (Piece const& piece : pieces) {
        Rigid const motion = piece.sums.fit();
        if (std::abs(motion.turn) > largest_turn) continue;
        if (std::size_t const count = support(votes, motion); count > most) {
            most = count;
            best = motion;
        }
    }
    if (most < least_support) return {};
    RigidSums all;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if ((votes[i].y - best(votes[i].x)).squaredNorm() <= votes[i].limit) all.add(pieces[i].sums);
    return all.fit();
}

void PlacementCheck::judge(UnitPair& units, Steady when) {
    for (auto it = units.open.begin(); it != units.open.end();) {
        Piece const& piece = it->second;
        bool const ends = when - piece.began >= piece_length || when - piece.last > longest_gap;
        if (ends && is_vote(piece)) units.votes.push_back(piece);
        it = ends ? units.open.erase(it) : std::next(it);
    }
    while (!units.votes.empty() && (units.votes.size() > most_votes || when - units.votes.front().last > vote_memory))
        units.votes.pop_front();
    auto const motion = winner(units.votes);
    if (!motion) return;
    double in_deviations = 0;
    double in_metres = 0;
    for (Piece const& piece : units.votes) {
        Vector const off = (*motion)(piece.sums.mean_x()) - piece.sums.mean_x();
        in_deviations += std::pow(deviations(off, piece.mean_covariance()), 2);
        in_metres += off.squaredNorm();
    }
    auto const count = static_cast<double>(units.votes.size());
    in_deviations = std::sqrt(in_deviations / count);
    units.displacement = {std::sqrt(in_metres / count), motion->turn};
    if (in_deviations > wrong_beyond) units.verdict = Verdict::wrong;
    if (in_deviations < right_within) units.verdict = Verdict::right;
}

void PlacementCheck::judge(Steady when) {
    for (auto& [key, units] : pairs_) judge(units, when);
}

void PlacementCheck::forget(int unit) {
    std::erase_if(pairs_, [&](auto const& entry) { return entry.first.first == unit || entry.first.second == unit; });
}

std::vector<int> PlacementCheck::compared_with(int unit) const {
    std::vector<int> others;
    for (auto const& [key, units] : pairs_) {
        if (units.verdict == Verdict::unknown) continue;
        if (key.first == unit) others.push_back(key.second);
        if (key.second == unit) others.push_back(key.first);
    }
    return others;
}

std::optional<Displacement> PlacementCheck::displaced(int unit) const {
    std::size_t known = 0;
    std::vector<Displacement> wrong;
    for (auto const& [key, units] : pairs_) {
        if (units.verdict == Verdict::unknown || (key.first != unit && key.second != unit)) continue;
        ++known;
        if (units.verdict != Verdict::wrong) continue;
        wrong.push_back(units.displacement);
        // The motion is that from the first unit's persons to the second's.
        if (key.first == unit) wrong.back().turn *= -1;
    }
    if (2 * wrong.size() <= known) return {};
    Displacement mean;
    for (auto const& each : wrong) {
        mean.distance += each.distance / static_cast<double>(wrong.size());
        mean.turn += each.turn / static_cast<double>(wrong.size());
    }
    return mean;
}

}  // namespace rois::choosing
