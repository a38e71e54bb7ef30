// The samples in schemas/samples.
#include <gmock/gmock.h>

#include <set>

#include "xml/speaking.hpp"

namespace rois::xml {
namespace {

using testing::StartsWith;

std::set<std::filesystem::path> documents_in(std::filesystem::path const& folder) {
    std::set<std::filesystem::path> found;
    for (auto const& entry : std::filesystem::directory_iterator{folder}) {
        if (entry.path().extension() == ".xml") found.insert(entry.path());
    }
    return found;
}

TEST(Samples, InTheFolderValidAreValid) {
    auto const all = documents_in(samples() / "valid");
    EXPECT_GE(all.size(), 50u);
    for (auto const& path : all) EXPECT_EQ(problem(path.filename(), file(path)), "");
}

TEST(Samples, OnlyRequestsAreAccepted) {
    std::set<std::size_t> operations;
    for (auto const& path : documents_in(samples() / "valid")) {
        auto const answer = read(file(path));
        if (auto const* taken = std::get_if<Request>(&answer)) {
            operations.insert(taken->operation.index());
        } else {
            EXPECT_EQ(std::get<Fault>(answer).code, FaultCode::invalid) << path;
            EXPECT_THAT(std::get<Fault>(answer).reason, StartsWith("unknown operation")) << path;
        }
    }
    EXPECT_EQ(operations.size(), std::variant_size_v<Operation>) << "an operation has no sample";
}

TEST(Samples, InTheFolderInvalidAreRefusedAtTheirLine) {
    std::ifstream manifest{samples() / "invalid" / "manifest.tsv"};
    std::size_t checked = 0;
    for (std::string name, line, why;
         std::getline(manifest, name, '\t') && std::getline(manifest, line, '\t') && std::getline(manifest, why);) {
        auto const text = file(samples() / "invalid" / name);
        EXPECT_THAT(problem(name, text), StartsWith(std::string{name}.append(":").append(line).append(":"))) << why;
        EXPECT_EQ(fault(text).code, FaultCode::invalid) << name;
        ++checked;
    }
    EXPECT_EQ(checked, documents_in(samples() / "invalid").size());
}

}  // namespace
}  // namespace rois::xml
