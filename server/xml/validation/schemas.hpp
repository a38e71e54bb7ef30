// The XSD files for validation, compiled once at start and shared by all threads.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace rois::xml {

// Initializes xerces-c, and terminates it in the destructor. Must be the first object of main. Disables document types for the
// whole process.
class Platform {
public:
    Platform();
    ~Platform();
    Platform(Platform const&) = delete;
    Platform& operator=(Platform const&) = delete;
};

using NamedFiles = std::map<std::string, std::string_view, std::less<>>;  // file name -> text

// A locked grammar pool. Immutable and thread-safe.
class Schemas {
public:
    // `files` must contain every imported or included schema, by the name in schemaLocation. Throws std::runtime_error with file,
    // line and column if one cannot be compiled.
    explicit Schemas(NamedFiles files);
    ~Schemas();
    Schemas(Schemas const&) = delete;
    Schemas& operator=(Schemas const&) = delete;

    NamedFiles const& files() const { return files_; }

    class Grammars;  // internal to server/xml
    Grammars const& grammars() const { return *grammars_; }

private:
    NamedFiles files_;
    std::unique_ptr<Grammars> grammars_;
};

}  // namespace rois::xml
