#include "engine/frames/frames.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <span>
#include <stdexcept>
#include <utility>

#include "engine/frames/frame_step.hpp"
#include "engine/frames/space.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

using Axes = std::span<Eigen::Index const>;

// The axes (x, y, z, roll, pitch, yaw) that a covariance with this many numbers covers; empty if the number is invalid.
Axes axes_of(std::size_t numbers, bool oriented) {
    static constexpr std::array<Eigen::Index, 6> all{0, 1, 2, 3, 4, 5};
    static constexpr std::array<Eigen::Index, 3> in_plane{0, 1, 5};
    static constexpr std::array<Eigen::Index, 4> upright{0, 1, 2, 5};
    switch (numbers) {
        case 4:
            return Axes{all}.first(2);
        case 9:
            return oriented ? Axes{in_plane} : Axes{all}.first(3);
        case 16:
            return oriented ? Axes{upright} : Axes{};
        case 36:
            return oriented ? Axes{all} : Axes{};
        default:
            return {};
    }
}

Covariance6 whole(std::vector<double> const& rows, Axes axes) {
    Covariance6 covariance = Covariance6::Zero();
    for (std::size_t i = 0; i < axes.size(); ++i)
        for (std::size_t j = 0; j < axes.size(); ++j) covariance(axes[i], axes[j]) = rows[i * axes.size() + j];
    return (covariance + covariance.transpose()) / 2;
}

std::vector<double> rows_of(Covariance6 const& covariance, Axes axes) {
    auto const size = static_cast<Eigen::Index>(axes.size());
    Eigen::MatrixXd part(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index j = 0; j < size; ++j) part(i, j) = covariance(axes[i], axes[j]);
    part = rounded_covariance(part);
    std::vector<double> rows;
    for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index j = 0; j < size; ++j) rows.push_back(part(i, j));
    return rows;
}

double rounded(double value, Frames::Rounding rounding) {
    double const parts = rounding == Frames::Rounding::thousandth ? 1e3 : 1e6;
    return std::round(value * parts) / parts + 0.0;  // turns -0 into 0
}

double rounded_angle(double degrees, Frames::Rounding rounding) { return normal_angle(rounded(normal_angle(degrees), rounding)); }

std::array<double, 3> array_of(Eigen::Vector3d const& v, Frames::Rounding rounding) {
    return {rounded(v.x(), rounding), rounded(v.y(), rounding), rounded(v.z(), rounding)};
}

Eigen::Vector3d vector_of(std::span<double const, 3> numbers) { return {numbers[0], numbers[1], numbers[2]}; }

std::string strange(Located const& located, std::string const& what) {
    return "the position of " + quoted(located.ref) + " has " + what;
}

}  // namespace

struct Frames::Placed {
    Frame frame;
    Placement placement;
};

struct Frames::Step {
    PoseInFrame (*take)(PoseInFrame const&, Placement const&);
    Placed const* placed;

    bool tilts() const { return placed->placement.turned.x() != 0 || placed->placement.turned.y() != 0; }

    static PoseInFrame all(PoseInFrame where, std::vector<Step> const& way) {
        for (auto const& step : way) where = step.take(where, step.placed->placement);
        return where;
    }
};

Frames::Frames(std::string own, std::vector<Frame> others) : own_{std::move(own)} { add(std::move(others)); }

Frames Frames::with(std::vector<Frame> others) const {
    auto all = *this;
    all.add(std::move(others));
    return all;
}

void Frames::add(std::vector<Frame> others) {
    for (auto& frame : others) insert(std::move(frame));
    for (auto const& [key, placed] : placed_) {
        auto const& frame = placed->frame;
        if (!know(frame.base)) throw std::invalid_argument(unknown_base(frame) + "; expected one of " + first_listed(names()));
        if (ancestry(frame.crs).size() > placed_.size())
            throw std::invalid_argument("the frame " + quoted(frame.crs, 200) + " is placed in itself, through " +
                                        quoted(frame.base, 200));
    }
}

void Frames::insert(Frame frame) {
    if (own_.empty() || frame.crs.empty()) throw std::invalid_argument("a frame, or the engine's own frame, has no name");
    if (frame.base.empty()) frame.base = own_;
    auto const placement = Placement::of(frame);
    auto key = lower_case(frame.crs);
    if (equal_ignoring_case(frame.crs, own_) || placed_.contains(key))
        throw std::invalid_argument("the frame " + quoted(frame.crs, 200) + " is given twice");
    placed_.emplace(std::move(key), std::make_shared<Placed const>(Placed{std::move(frame), placement}));
}

std::optional<std::string> Frames::include(Frame frame) {
    if (!know(frame.base)) return unknown_base(frame);
    try {
        insert(std::move(frame));
    } catch (std::invalid_argument const& problem) {
        return problem.what();
    }
    return {};
}

std::string Frames::unknown_base(Frame const& frame) {
    return "the frame " + quoted(frame.crs, 200) + " is placed in " + quoted(frame.base, 200) + ", which is unknown";
}

bool Frames::know(std::string_view crs) const { return crs.empty() || equal_ignoring_case(crs, own_) || find(crs) != nullptr; }

std::vector<std::string> Frames::names() const {
    std::vector<std::string> names;
    if (!own_.empty()) names.push_back(own_);
    for (auto const& [key, placed] : placed_) names.push_back(placed->frame.crs);
    return names;
}

std::vector<Frame> Frames::others() const {
    std::vector<Frame> frames;
    frames.reserve(placed_.size());
    for (auto const& [key, placed] : placed_) frames.push_back(placed->frame);
    std::ranges::stable_sort(frames, {}, [&](Frame const& frame) { return ancestry(frame.crs).size(); });
    return frames;
}

Frames::Placed const* Frames::find(std::string_view crs) const {
    if (placed_.empty() || crs.empty()) return nullptr;
    auto const found = placed_.find(lower_case(crs));
    return found == placed_.end() ? nullptr : found->second.get();
}

// The frame, the frame that it is placed in, and so on, without the engine's own. If the frames form a cycle, the result has more
// entries than there are frames.
std::vector<Frames::Placed const*> Frames::ancestry(std::string_view crs) const {
    std::vector<Placed const*> all;
    for (auto const* placed = find(crs); placed != nullptr && all.size() <= placed_.size(); placed = find(placed->frame.base))
        all.push_back(placed);
    return all;
}

// The way up to the first common ancestor of the two frames, and down from there. The placement of the ancestor itself is not
// used, so its uncertainty does not count. Returns nullopt if a frame is unknown.
std::optional<std::vector<Frames::Step>> Frames::way(std::string_view from, std::string_view to) const {
    if (!know(from) || !know(to)) return {};
    auto up = ancestry(from), down = ancestry(to);
    while (!up.empty() && !down.empty() && up.back() == down.back()) {
        up.pop_back();
        down.pop_back();
    }
    std::vector<Step> steps;
    steps.reserve(up.size() + down.size());
    for (auto const* placed : up) steps.push_back({to_base, placed});
    for (auto const* placed : std::views::reverse(down)) steps.push_back({from_base, placed});
    return steps;
}

std::optional<std::string> Frames::change(Located& located, std::string_view to) const {
    auto const steps = way(located.crs, to);
    if (!steps || steps->empty()) return {};
    bool const oriented = located.orientation.size() == 3;
    if (!oriented && !located.orientation.empty())
        return strange(located, "an orientation of " + std::to_string(located.orientation.size()) + " numbers");
    PoseInFrame where{.position = vector_of(located.position), .turned = Eigen::Vector3d::Zero(), .covariance = {}};
    if (oriented) where.turned = {located.orientation[0], located.orientation[1], located.orientation[2]};
    auto* const covariance = std::get_if<Located::Covariance>(&located.certainty);
    auto const axes = covariance == nullptr ? Axes{} : axes_of(covariance->rows.size(), oriented);
    if (covariance != nullptr && axes.empty())
        return strange(located, "a covariance of " + std::to_string(covariance->rows.size()) + " numbers" +
                                    (oriented ? "" : " without an orientation"));
    if (covariance != nullptr) where.covariance = whole(covariance->rows, axes);
    where = Step::all(std::move(where), *steps);
    located.crs = to.empty() ? own_ : std::string{to};
    located.position = array_of(where.position, Rounding::thousandth);
    if (oriented) {
        std::ranges::transform(where.turned, located.orientation.begin(),
                               [](double angle) { return rounded_angle(angle, Rounding::thousandth); });
    }
    if (covariance != nullptr) covariance->rows = rows_of(*where.covariance, axes);
    return {};
}

std::optional<std::string> Frames::moved(std::string_view text, std::vector<Step> const& way, Rounding rounding) {
    auto const read = point(text, {});
    if (!read) return {};
    bool const oriented = std::ranges::count(text, ',') == 2;
    PoseInFrame where{.position = vector_of(read->low), .turned = Eigen::Vector3d::Zero(), .covariance = {}};
    if (oriented) where.turned.z() = to_double(text.substr(text.rfind(',') + 1)).value_or(0);
    where = Step::all(std::move(where), way);
    auto const number = [&](double value) { return canonical(rounded(value, rounding)); };
    auto made = number(where.position.x()) + ", " + number(where.position.y());
    if (oriented) made += ", " + canonical(rounded_angle(where.turned.z(), rounding));
    return made;
}

void Frames::change(Parameter& parameter, std::string_view to, Rounding rounding) const {
    auto& crs = parameter.data_type_ref.codebook_ref;
    auto const steps = way(crs, to);
    if (!steps || steps->empty()) return;
    for (auto& value : parameter.values)
        if (auto there = moved(value, *steps, rounding)) value = std::move(*there);
    crs = to.empty() ? own_ : std::string{to};
}

std::optional<std::string> Frames::change_to_own(Results& results) const {
    if (are_one()) return {};
    for (auto& parameter : results.parameters)
        if (find(parameter.data_type_ref.codebook_ref) != nullptr) change(parameter, own_, Rounding::thousandth);
    for (auto& located : results.located)
        if (auto problem = change(located, own_)) return problem;
    return {};
}

bool Frames::share(Geometry const& a, Geometry const& b) const {
    if (are_one()) return share_a_frame(a, b);
    return equal_ignoring_case(a.crs.empty() ? own_ : a.crs, b.crs.empty() ? own_ : b.crs);
}

std::optional<Geometry> Frames::moved(Geometry const& geometry, std::string_view to) const {
    bool const point = geometry.shape == Geometry::Shape::box && geometry.low == geometry.high;
    if (are_one() || (geometry.shape == Geometry::Shape::box && !point)) return {};
    auto const steps = way(geometry.crs, to);
    if (!steps || (!point && std::ranges::any_of(*steps, &Step::tilts))) return {};
    auto const moved_point = [&](std::array<double, 3> const& from) {
        return array_of(
            Step::all({.position = vector_of(from), .turned = Eigen::Vector3d::Zero(), .covariance = {}}, *steps).position,
            Rounding::millionth);
    };
    auto there = geometry;
    there.crs = to.empty() ? own_ : std::string{to};
    if (point) {
        there.low = there.high = moved_point(geometry.low);
        if (there.dimensions < 3) there.low[2] = there.high[2] = 0;
        return there;
    }
    for (auto& path : there.paths) {
        for (auto& [x, y] : path) {
            auto const here = moved_point({x, y, 0});
            x = here[0];
            y = here[1];
        }
    }
    there.fit_corners();
    return there;
}

}  // namespace rois
