// The XSD files that the server validates with, compiled once at start and shared by all threads.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace rois::xml {

// Starts and ends xerces-c for the whole program: the first object of main. Document types are switched off for good (bad-input
// 1).
class Platform {
public:
    Platform();
    ~Platform();
    Platform(Platform const&) = delete;
    Platform& operator=(Platform const&) = delete;
};

using NamedFiles = std::map<std::string, std::string_view, std::less<>>;  // file name -> text

// A locked grammar pool. Immutable; any thread may read with it.
class Schemas {
public:
    // `files` hold every schema that another one imports or includes, by the name in its schemaLocation. Throws
    // std::runtime_error naming file, line and column when one cannot be compiled.
    explicit Schemas(NamedFiles files);
    ~Schemas();
    Schemas(Schemas const&) = delete;
    Schemas& operator=(Schemas const&) = delete;

    NamedFiles const& files() const { return files_; }

    class Grammars;  // inside the xml layer only
    Grammars const& grammars() const { return *grammars_; }

private:
    NamedFiles files_;
    std::unique_ptr<Grammars> grammars_;
};

}  // namespace rois::xml
