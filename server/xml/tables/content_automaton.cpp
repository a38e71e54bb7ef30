#include "xml/tables/content_automaton.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <xercesc/framework/psvi/XSModelGroup.hpp>

namespace rois::xml {

namespace {

using Position = std::uint32_t;  // one occurrence of an element in the model, with bounded occurrences expanded
using Positions = std::set<Position>;

constexpr std::size_t most_positions = 512;
constexpr std::size_t most_states = 1024;

// The positions that a part of the model may begin and end with.
struct Part {
    bool nullable = true;
    Positions first, last;
};

// Glushkov's construction: the positions that may follow each position.
class Model {
public:
    explicit Model(std::size_t budget) : budget_{budget} {}

    std::optional<Part> particle(xercesc::XSParticle& particle) {
        if (particle.getTermType() == xercesc::XSParticle::TERM_EMPTY) return Part{};
        Part all;
        auto const least = particle.getMinOccurs();
        bool const unbounded = particle.getMaxOccursUnbounded();
        auto const copies = unbounded ? std::max<XMLSize_t>(least, 1) : particle.getMaxOccurs();
        for (XMLSize_t i = 0; i < copies; ++i) {
            auto one = term(particle);
            if (!one) return std::nullopt;
            one->nullable = one->nullable || i >= least;
            if (unbounded && i + 1 == copies) follow(one->last, one->first);
            all = sequence(std::move(all), *one);
        }
        return all;
    }

    std::vector<xercesc::XSElementDeclaration*> const& elements() const { return elements_; }
    Positions const& following(Position at) const { return following_[at]; }

private:
    std::optional<Part> term(xercesc::XSParticle& particle) {
        switch (particle.getTermType()) {
            case xercesc::XSParticle::TERM_ELEMENT:
                return element(*particle.getElementTerm());
            case xercesc::XSParticle::TERM_MODELGROUP:
                return group(*particle.getModelGroupTerm());
            default:
                return std::nullopt;
        }
    }

    std::optional<Part> element(xercesc::XSElementDeclaration& declaration) {
        if (elements_.size() == budget_) return std::nullopt;
        auto const position = static_cast<Position>(elements_.size());
        elements_.push_back(&declaration);
        following_.emplace_back();
        return Part{false, {position}, {position}};
    }

    std::optional<Part> group(xercesc::XSModelGroup& group) {
        bool const choice = group.getCompositor() == xercesc::XSModelGroup::COMPOSITOR_CHOICE;
        auto const* const particles = group.getParticles();
        if (group.getCompositor() == xercesc::XSModelGroup::COMPOSITOR_ALL || particles == nullptr || particles->size() == 0) {
            return std::nullopt;
        }
        Part all{.nullable = !choice, .first = {}, .last = {}};
        for (XMLSize_t i = 0; i < particles->size(); ++i) {
            auto const one = particle(*const_cast<xercesc::XSParticleList*>(particles)->elementAt(i));
            if (!one) return std::nullopt;
            all = choice ? either(std::move(all), *one) : sequence(std::move(all), *one);
        }
        return all;
    }

    Part sequence(Part before, Part const& after) {
        follow(before.last, after.first);
        if (before.nullable) before.first.insert(after.first.begin(), after.first.end());
        if (!after.nullable) before.last.clear();
        before.last.insert(after.last.begin(), after.last.end());
        before.nullable = before.nullable && after.nullable;
        return before;
    }

    static Part either(Part one, Part const& other) {
        one.first.insert(other.first.begin(), other.first.end());
        one.last.insert(other.last.begin(), other.last.end());
        one.nullable = one.nullable || other.nullable;
        return one;
    }

    void follow(Positions const& before, Positions const& after) {
        for (auto const at : before) following_[at].insert(after.begin(), after.end());
    }

    std::size_t budget_;
    std::vector<xercesc::XSElementDeclaration*> elements_;
    std::vector<Positions> following_;
};

// Makes the automaton deterministic: each state is a set of positions.
class AutomatonBuilder {
public:
    AutomatonBuilder(Model const& model, Part const& whole, NameOf const& name_of, DeclarationOf const& declaration_of)
        : model_{model}, last_{whole.last}, name_of_{name_of}, declaration_of_{declaration_of} {
        states_.push_back({{}, whole.nullable});
        next_.push_back(whole.first);
    }

    std::optional<std::vector<ContentState>> run() {
        for (std::size_t at = 0; at < states_.size(); ++at) {
            std::vector<std::pair<Name, Positions>> by_name;
            for (auto const position : Positions{next_[at]}) {
                auto const name = name_of_(*model_.elements()[position]);
                auto found = std::ranges::find(by_name, name, &std::pair<Name, Positions>::first);
                if (found == by_name.end()) found = by_name.insert(by_name.end(), {name, {}});
                found->second.insert(position);
            }
            for (auto const& [name, positions] : by_name) {
                auto const* const declaration = declaration_of_(*model_.elements()[*positions.begin()]);
                for (auto const each : positions) {
                    if (declaration_of_(*model_.elements()[each]) != declaration) return std::nullopt;
                }
                auto const state = state_of(positions);
                if (states_.size() > most_states) return std::nullopt;
                states_[at].transitions.push_back({name, declaration, state});
            }
        }
        return std::move(states_);
    }

private:
    std::uint32_t state_of(Positions const& positions) {
        auto const [found, is_new] = numbers_.try_emplace(positions, static_cast<std::uint32_t>(states_.size()));
        if (!is_new) return found->second;
        ContentState state;
        Positions next;
        for (auto const at : positions) {
            state.final = state.final || last_.contains(at);
            next.insert(model_.following(at).begin(), model_.following(at).end());
        }
        states_.push_back(std::move(state));
        next_.push_back(std::move(next));
        return found->second;
    }

    Model const& model_;
    Positions const& last_;
    NameOf const& name_of_;
    DeclarationOf const& declaration_of_;
    std::vector<ContentState> states_;
    std::vector<Positions> next_;  // of each state: the positions that may follow
    std::map<Positions, std::uint32_t> numbers_;
};

}  // namespace

std::optional<std::vector<ContentState>> automaton_of(xercesc::XSParticle* particle, NameOf const& name_of,
                                                      DeclarationOf const& declaration_of) {
    if (particle == nullptr) return std::nullopt;
    Model model{most_positions};
    auto const whole = model.particle(*particle);
    if (!whole) return std::nullopt;
    return AutomatonBuilder{model, *whole, name_of, declaration_of}.run();
}

}  // namespace rois::xml
