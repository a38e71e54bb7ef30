// fuzz-validator: changes documents at random, and fails on the first one that the tables accept and xerces-c does not.
#include <charconv>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <string_view>

#include "files/files.hpp"
#include "fuzz/comparison.hpp"
#include "fuzz/mutation.hpp"
#include "fuzz/samples.hpp"

namespace {

constexpr std::string_view usage = "usage: fuzz-validator [--documents N] [--seed N]\n";

struct Options {
    std::uint64_t documents = 1'000'000;
    std::uint64_t seed = 1;
};

bool read(int count, char** arguments, Options& options) {
    for (int i = 1; i < count; i += 2) {
        std::string_view const name{arguments[i]};
        auto* const number = name == "--documents" ? &options.documents : name == "--seed" ? &options.seed : nullptr;
        if (number == nullptr || i + 1 == count) return false;
        std::string_view const text{arguments[i + 1]};
        if (std::from_chars(text.data(), text.data() + text.size(), *number).ptr != text.data() + text.size()) return false;
    }
    return true;
}

}  // namespace

int main(int count, char** arguments) {
    using Outcome = rois::fuzz::Comparison::Outcome;
    Options options;
    if (!read(count, arguments, options)) {
        std::cerr << usage;
        return 2;
    }
    rois::xml::Platform const platform;
    rois::fuzz::Comparison comparison{std::make_shared<rois::xml::Schemas const>(rois::files::schemas())};
    rois::fuzz::Mutation mutation{rois::fuzz::samples(), options.seed};
    auto const begun = std::chrono::steady_clock::now();
    for (std::uint64_t i = 0; i < options.documents; ++i) {
        auto document = mutation.next();
        auto const outcome = comparison.look_at(document);
        if (outcome == Outcome::wrong) {
            std::cout << document << "\n\nis accepted by the tables, document " << i << " of seed " << options.seed << ": "
                      << comparison.complaint() << "\n";
            return 1;
        }
        if (outcome == Outcome::both || (outcome == Outcome::xerces_only && i % 8 == 0)) mutation.learn(std::move(document));
    }
    auto const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    std::cout << options.documents << " documents of seed " << options.seed << " in " << seconds << " s: accepted by both "
              << comparison.count(Outcome::both) << ", by xerces-c only " << comparison.count(Outcome::xerces_only)
              << ", by neither " << comparison.count(Outcome::neither) << "\n";
    return 0;
}
