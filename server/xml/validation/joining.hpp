// The documents of an engine that joins another one (docs/engines.md).
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "types/messages.hpp"

namespace rois::xml {

class CheckedReader;
class Schemas;

struct Join {
    std::string name;
    std::string instance;
};

struct JoinResponse : Outcome {
    std::chrono::milliseconds window{};
};

std::string encode(Join const&);
std::string encode(JoinResponse const&);

// Does not validate. Returns nothing for any other document.
std::optional<JoinResponse> read_join_response(std::string_view document);

// Validates. Not thread-safe.
class JoinReader {
public:
    explicit JoinReader(std::shared_ptr<Schemas const>);
    ~JoinReader();

    // Returns a fault for every other document.
    std::variant<Join, Fault> read(std::string_view document);

private:
    std::unique_ptr<CheckedReader> reader_;
};

}  // namespace rois::xml
