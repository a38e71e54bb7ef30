#include <algorithm>
#include <array>
#include <optional>
#include <regex>
#include <set>

#include "house/rules.hpp"
#include "house/text.hpp"

namespace rois::house {

namespace {

using Headers = std::vector<std::string>;  // prefixes of headers

Headers const xerces{"xercesc/"};
Headers const pugixml{"pugixml.hpp", "pugiconfig.hpp"};
Headers const boost{"boost/"};
Headers const boost_geometry{"boost/geometry/"};
Headers const boost_bytes{"boost/crc.hpp", "boost/endian/"};
Headers const boost_address{"boost/asio/ip/address.hpp"};    // a value, no socket
Headers const boost_streams{"boost/asio/", "boost/beast/"};  // for the health check
Headers const openssl{"openssl/"};
Headers const prometheus{"prometheus/"};
Headers const spdlog{"spdlog/"};
Headers const eigen{"Eigen/"};
Headers const cli11{"CLI/"};
Headers const json{"nlohmann/"};
Headers const sqlite{"sqlite3.h"};
Headers const jpeg{"jpeglib.h"};
Headers const rois{"rois/"};
Headers const posix{"arpa/",  "dirent.h",  "errno.h", "fcntl.h",  "locale.h", "malloc.h", "netdb.h",  "netinet/",
                    "poll.h", "pthread.h", "sched.h", "signal.h", "sys/",     "time.h",   "unistd.h", "wchar.h"};

// Headers that a layer may expose to the layers that use it: vectors and poses are part of the simulation's interface.
Headers const shown{eigen};

enum class Time { read, passed_in };

struct Layer {
    std::string folder;
    Headers uses;                    // headers of the project that the layer may include
    std::vector<Headers> libraries;  // besides the C++ standard library
    Time time;
};

// The arrows of ARCHITECTURE.md. Every folder with C++ files needs a row.
std::vector<Layer> const layers{
    {"server/types/", {"types/"}, {posix}, Time::passed_in},
    {"server/xml/", {"xml/", "types/"}, {xerces, pugixml}, Time::passed_in},
    {"server/engine/", {"engine/", "types/"}, {eigen, boost_geometry, {"fnmatch.h"}}, Time::passed_in},
    {"server/files/", {"files/"}, {}, Time::passed_in},
    {"server/journal/", {"journal/", "engine/", "xml/", "types/"}, {boost_bytes, json, sqlite, posix}, Time::read},
    {"server/gateway/",
     {"gateway/", "engine/", "xml/", "types/"},
     {boost_address, openssl, prometheus, spdlog, posix},
     Time::read},
    {"server/wire/", {"wire/", "gateway/process/telemetry.hpp", "types/"}, {boost, openssl, spdlog, posix}, Time::read},
    {"server/net/", {"net/", "wire/", "gateway/", "engine/", "xml/", "types/"}, {boost, spdlog, posix}, Time::read},
    {"server/main/",
     {"main/", "net/", "wire/", "gateway/", "journal/", "engine/", "xml/", "types/", "files/", "basic/", "simulation/",
      "choosing/choosing.hpp", "choosing/settings.hpp", "media/server.hpp", "media/settings.hpp", "remote/remote_engines.hpp",
      "remote/sub_engine.hpp"},
     {boost_streams, cli11, json, spdlog, posix},
     Time::read},
    {"components/media/", {"media/", "wire/credentials.hpp"}, {boost, jpeg}, Time::read},
    {"components/basic/",
     {"basic/", "engine/local_component.hpp", "types/", "media/media.hpp", "xml/profiles/document.hpp",
      "xml/validation/schemas.hpp"},
     {eigen},
     Time::passed_in},
    {"components/simulation/",
     {"simulation/", "basic/", "engine/", "types/", "media/media.hpp", "xml/profiles/document.hpp", "xml/validation/schemas.hpp"},
     {eigen},
     Time::passed_in},
    {"components/choosing/", {"choosing/", "engine/", "types/"}, {eigen}, Time::passed_in},
    {"components/remote/",
     {"remote/", "engine/engine.hpp", "engine/component.hpp", "types/", "xml/codec/codec.hpp", "xml/validation/joining.hpp",
      "xml/validation/schemas.hpp", "links/", "core/loop.hpp"},
     {boost, posix},
     Time::read},
    {"components/sdk/cpp/",
     {"sdk/cpp/", "basic/adapters/robots.hpp", "basic/body/body.hpp", "engine/", "gateway/", "net/", "xml/", "types/", "files/",
      "remote/remote_engines.hpp"},
     {cli11, spdlog},
     Time::read},
    {"client-cpp/include/rois/psm/", {"RoIS_"}, {}, Time::passed_in},
    {"client-cpp/include/", {"rois/", "types/"}, {}, Time::passed_in},
    {"client-cpp/source/", {"", "rois/", "types/", "xml/codec/"}, {boost, openssl}, Time::read},
    {"client-cpp/command/",
     {"command/", "rois/", "links/byte_stream.hpp", "links/target.hpp", "types/", "xml/codec/codec.hpp", "xml/codec/decoding.hpp",
      "xml/profiles/document.hpp", "xml/codec/encoding.hpp", "xml/codec/names.hpp", "xml/validation/schemas.hpp", "files/"},
     {boost, cli11, json, pugixml, posix},
     Time::read},
    {"client-cpp/psm/",
     {"psm/", "rois/", "types/", "xml/codec/codec.hpp", "xml/codec/names.hpp", "xml/codec/writer.hpp"},
     {pugixml},
     Time::passed_in},
    {"client-cpp/examples/", {"RoIS_"}, {rois}, Time::read},
};

std::array<std::string, 6> const include_folders{
    "server/", "components/", "client-cpp/", "client-cpp/include/", "client-cpp/source/", "client-cpp/include/rois/psm/"};
std::array<std::string, 3> const layered_folders{"server/", "components/", "client-cpp/"};

struct Include {
    std::string name;
    std::size_t line;
    enum { of_the_project, of_a_library } from;
};

std::vector<Include> includes(std::string_view text) {
    static std::regex const directive(R"re(\s*#\s*include\s*([<"])([^>"]+)[>"].*)re");
    std::vector<Include> found;
    for_each_line(text, [&](std::string const& line, std::size_t number) {
        std::smatch match;
        if (line.find("include") != line.npos && std::regex_match(line, match, directive))
            found.push_back({match[2], number, match[1] == "\"" ? Include::of_the_project : Include::of_a_library});
    });
    return found;
}

bool is_one_of(Headers const& headers, std::string_view name) {
    return std::ranges::any_of(headers, [&](auto const& beginning) { return name.starts_with(beginning); });
}

bool is_of_the_standard_library(std::string_view header) { return header.find_first_of("./") == header.npos; }

bool may_see(Layer const& layer, std::string_view header) {
    return is_of_the_standard_library(header) ||
           std::ranges::any_of(layer.libraries, [&](Headers const& library) { return is_one_of(library, header); });
}

Layer const* layer_of(std::string_view file) {
    auto const found = std::ranges::find_if(layers, [&](Layer const& layer) { return file.starts_with(layer.folder); });
    return found == layers.end() ? nullptr : &*found;
}

std::optional<std::string> file_of(Tree const& tree, std::string const& header) {
    for (auto const& folder : include_folders)
        if (tree.contains(folder + header)) return folder + header;
    return {};
}

// The library headers that including `file` includes as well, each with the file that includes it.
std::map<std::string, std::string> brought_along(Tree const& tree, std::string const& file) {
    std::map<std::string, std::string> brought;
    std::set<std::string> seen{file};
    std::vector<std::string> todo{file};
    while (!todo.empty()) {
        auto const here = todo.back();
        todo.pop_back();
        for (auto const& include : includes(tree.at(here))) {
            if (include.from == Include::of_a_library) {
                brought.try_emplace(include.name, here);
            } else if (auto const next = file_of(tree, include.name); next && seen.insert(*next).second) {
                todo.push_back(*next);
            }
        }
    }
    return brought;
}

void judge_own(Tree const& tree, std::string const& file, Layer const& layer, Include const& include, Complaints& complaints) {
    auto const header = file_of(tree, include.name);
    if (!header) {
        complaints.push_back(at(file, include.line) + "\"" + include.name +
                             "\" is not a file under server/, components/ or client-cpp/");
        return;
    }
    if (!is_one_of(layer.uses, include.name)) {
        complaints.push_back(at(file, include.line) + layer.folder + " may not use \"" + include.name + "\"");
        return;
    }
    if (header->starts_with(layer.folder)) return;
    for (auto const& [library, through] : brought_along(tree, *header))
        if (!may_see(layer, library) && !is_one_of(shown, library))
            complaints.push_back(at(file, include.line)
                                     .append(layer.folder)
                                     .append(" may not see <")
                                     .append(library)
                                     .append("> through ")
                                     .append(through));
}

using Definitions = std::map<std::string, std::vector<Layer const*>>;  // name of a class -> the layers that define one

// Public headers of client-cpp declare the classes of its source.
bool may_hide_classes(Layer const& layer) { return layer.folder.starts_with("client-cpp/"); }

Definitions definitions(Tree const& tree) {
    static std::regex const definition(R"re(\b(?:class|struct)\s+(?:\w+::)*(\w+)(?:\s+final)?\s*(?::[^;{]*)?\{)re");
    Definitions found;
    for (auto const& [file, text] : tree) {
        auto const* const layer = layer_of(file);
        if (!is_cpp(file) || layer == nullptr) continue;
        auto const code = code_alone(text);
        for (std::sregex_iterator match{code.begin(), code.end(), definition}, end; match != end; ++match)
            found[(*match)[1]].push_back(layer);
    }
    return found;
}

// A forward declaration must not name a class of a layer that this layer may not use.
void judge_declarations(Definitions const& definitions, std::string const& file, std::string const& text, Layer const& layer,
                        Complaints& complaints) {
    static std::regex const declaration(R"re(\s*(?:class|struct)\s+(\w+)\s*;.*)re");
    for_each_line(code_alone(text), [&](std::string const& line, std::size_t number) {
        std::smatch match;
        if (line.find(';') == line.npos || !std::regex_match(line, match, declaration)) return;
        auto const found = definitions.find(match[1]);
        if (found == definitions.end()) return;
        auto const may_name = [&](Layer const* other) {
            auto const name = other->folder.substr(other->folder.find('/') + 1);  // "engine/"
            return other == &layer || std::ranges::any_of(layer.uses, [&](auto const& used) { return used.starts_with(name); });
        };
        if (std::ranges::none_of(found->second, may_name))
            complaints.push_back(at(file, number) + layer.folder + " may not declare " + match.str(1) + ", which " +
                                 found->second.front()->folder + " defines");
    });
}

}  // namespace

Complaints against_layers(Tree const& tree) {
    Complaints complaints;
    auto const defined = definitions(tree);
    for (auto const& [file, text] : tree) {
        if (!is_cpp(file) || std::ranges::none_of(layered_folders, [&](auto const& folder) { return file.starts_with(folder); }))
            continue;
        auto const* const layer = layer_of(file);
        if (!layer) {
            complaints.push_back(at(file, 1) + "this folder is in no layer: tests/house/layers.cpp lists them");
            continue;
        }
        if (!may_hide_classes(*layer)) judge_declarations(defined, file, text, *layer, complaints);
        for (auto const& include : includes(text)) {
            if (include.from == Include::of_the_project) {
                judge_own(tree, file, *layer, include, complaints);
            } else if (!may_see(*layer, include.name)) {
                complaints.push_back(at(file, include.line) + layer->folder + " may not see <" + include.name + ">");
            }
        }
    }
    return complaints;
}

Complaints against_passed_in_time(Tree const& tree) {
    static std::regex const reading(
        R"re(::\s*now\b(?!\s*\(\s*\)\s*const)|\btime\s*\(\s*(nullptr|NULL|0|&)|\b(clock_gettime|gettimeofday|sleep_for|sleep_until|random_device)\b)re");
    Complaints complaints;
    for (auto const& [file, text] : tree) {
        auto const* const layer = layer_of(file);
        if (!is_cpp(file) || !layer || layer->time == Time::read) continue;
        for_each_line(code_alone(text), [&](std::string const& line, std::size_t number) {
            std::smatch match;
            if (std::regex_search(line, match, reading))
                complaints.push_back(at(file, number) + "time and chance are passed to " + layer->folder +
                                     ", not read: " + match.str());
        });
    }
    return complaints;
}

}  // namespace rois::house
