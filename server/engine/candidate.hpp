// What a condition is held against: a component, an event of one, or the results of something.
#pragma once

#include <cstddef>
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

class Candidate;

// Who has bound a component, as seen by the condition's asker; in the order in which the asker gets the component most easily.
enum class Holder : std::uint8_t { asker, nobody, another_session };

// What a condition on a group makes of one robot.
struct GroupVerdict {
    Match match = Match::no;
    // How the asker gets the group's components from this robot; set if the robot matches.
    std::size_t bound = 0;                  // those that the asker has bound
    std::vector<Candidate const*> to_bind;  // those that it lacks and that are free
    Candidate const* held = nullptr;        // one that it lacks and that only other sessions have; null if there is none
};

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

    // Where the verdict of a condition on a group about this candidate's robot is kept, for as long as the robots are looked at;
    // null for what belongs to no robot.
    virtual std::optional<GroupVerdict>* verdict(void const* group) const = 0;

    // Nobody can bind what is not a component.
    virtual Holder holder() const { return Holder::nobody; }
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
    std::optional<GroupVerdict>* verdict(void const* group) const override { return component_.verdict(group); }
    Holder holder() const override { return component_.holder(); }

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
    std::optional<GroupVerdict>* verdict(void const*) const override { return nullptr; }

private:
    Results const& results_;
    std::string_view id_;
};

}  // namespace rois
