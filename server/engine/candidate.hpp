// What a condition is held against: a component, an event of one, or the results of something.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/vocabulary.hpp"
#include "types/values.hpp"

namespace rois {

// How far something is from fulfilling a condition. `maybe`: what it depends on is not known yet or may change.
enum class Match : std::uint8_t { no, maybe, yes };

using Texts = std::vector<std::string>;
using Positions = std::vector<Geometry>;

class Candidate {
public:
    virtual ~Candidate() = default;

    // The values that a reference stands for, none when it has no value here; nothing while that is open.
    virtual std::optional<Texts> texts(Reference const&) const = 0;
    virtual std::optional<Positions> positions(Reference const&) const = 0;

    // Whether it has such a property at all, be it without a value.
    virtual bool has(Reference const&) const = 0;

    // What ResourceId names; empty for what has no name.
    virtual std::string_view rid() const = 0;

    // All components of its robot (its engine); none for what belongs to none.
    virtual std::vector<Candidate const*> robot() const = 0;

    // Where it is kept what a condition on a group makes of this one's robot, for as long as the robots are looked at; null for
    // what belongs to none.
    virtual std::optional<Match>* verdict(void const* group) const = 0;
};

// A component together with the results of an event of it, or of its answer to a query. What it refers to lives longer.
class ToldCandidate final : public Candidate {
public:
    ToldCandidate(Candidate const& component, Results const& results) : component_{component}, results_{results} {}

    std::optional<Texts> texts(Reference const&) const override;
    std::optional<Positions> positions(Reference const&) const override;
    bool has(Reference const&) const override;
    std::string_view rid() const override { return component_.rid(); }
    std::vector<Candidate const*> robot() const override { return component_.robot(); }
    std::optional<Match>* verdict(void const* group) const override { return component_.verdict(group); }

private:
    Candidate const& component_;
    Results const& results_;
};

// Results alone, with the id that they were asked by.
class ResultsCandidate final : public Candidate {
public:
    ResultsCandidate(Results const& results, std::string_view id) : results_{results}, id_{id} {}

    std::optional<Texts> texts(Reference const&) const override;
    std::optional<Positions> positions(Reference const&) const override;
    bool has(Reference const&) const override;
    std::string_view rid() const override { return id_; }
    std::vector<Candidate const*> robot() const override { return {}; }
    std::optional<Match>* verdict(void const*) const override { return nullptr; }

private:
    Results const& results_;
    std::string_view id_;
};

}  // namespace rois
