#include "fuzz/mutation.hpp"

#include <array>
#include <utility>

#include "fuzz/change.hpp"

namespace rois::fuzz {

namespace {

constexpr std::size_t longest = 12'000;  // bytes of a document that is changed further
constexpr std::size_t most_learnt = 400;

}  // namespace

Mutation::Mutation(std::vector<std::string> samples, std::uint64_t seed)
    : samples_{std::move(samples)}, given_{samples_.size()}, random_{seed} {}

std::string Mutation::next() {
    // Half of them use learnt pieces.
    auto const below = random_() % 2 == 0 ? given_ : samples_.size();
    auto text = samples_[static_cast<std::size_t>(random_() % below)];
    auto const changes = std::array<std::size_t, 6>{1, 1, 1, 2, 2, 4}[static_cast<std::size_t>(random_() % 6)];
    for (std::size_t i = 0; i < changes; ++i) text = Change{std::move(text), samples_, random_}.apply();
    return text;
}

void Mutation::learn(std::string document) {
    if (document.size() > longest) return;
    if (samples_.size() < given_ + most_learnt) {
        samples_.push_back(std::move(document));
    } else {
        samples_[given_ + oldest_++ % most_learnt] = std::move(document);
    }
}

}  // namespace rois::fuzz
