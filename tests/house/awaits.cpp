#include <algorithm>
#include <regex>

#include "house/rules.hpp"
#include "house/text.hpp"

namespace rois::house {

Complaints against_braces_in_awaits(Tree const& tree) {
    // Our own types begin with an upper-case letter. Library types that are made like this have constructors.
    static std::regex const braces(R"re([(,]\s*((\w+::)*[A-Z]\w*)?\s*\{)re");
    static constexpr std::string_view await = "co_await";
    Complaints complaints;
    for (auto const& [file, text] : tree) {
        if (!is_cpp(file)) continue;
        auto const code = code_alone(text);
        for (auto found = code.find(await); found != code.npos; found = code.find(await, found + await.size())) {
            auto const statement = code.substr(found, code.find(';', found) - found);
            if (!std::regex_search(statement, braces)) continue;
            auto const line = 1 + std::ranges::count(code.substr(0, found), '\n');
            complaints.push_back(at(file, static_cast<std::size_t>(line)) +
                                 "give the braced structure a name before the co_await: g++ 12 destroys it twice otherwise");
        }
    }
    return complaints;
}

}  // namespace rois::house
