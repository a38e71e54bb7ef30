// Documents that are almost valid: samples, changed a little, as a broken or a malicious sender might do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace rois::fuzz {

// The same seed and the same samples give the same documents.
class Mutation {
public:
    Mutation(std::vector<std::string> samples, std::uint64_t seed);

    std::string next();

    // A document that went through is worth changing further.
    void learn(std::string document);

private:
    std::vector<std::string> samples_;
    std::size_t given_;  // how many of them are the given ones; the others were learnt
    std::size_t oldest_ = 0;
    std::mt19937_64 random_;
};

}  // namespace rois::fuzz
