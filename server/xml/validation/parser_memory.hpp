// The memory manager of one xerces-c parser.
#pragma once

#include <array>
#include <cstddef>
#include <xercesc/framework/MemoryManager.hpp>

namespace rois::xml {

// Allocates blocks whose size is a power of two, and keeps freed blocks for the next document. Counts the bytes in use, so that
// the validator can replace a parser that keeps too many. Not thread-safe.
class ParserMemory : public xercesc::MemoryManager {
public:
    ParserMemory() = default;
    ~ParserMemory() override;
    ParserMemory(ParserMemory const&) = delete;
    ParserMemory& operator=(ParserMemory const&) = delete;

    void* allocate(XMLSize_t size) override;
    void deallocate(void* block) override;
    xercesc::MemoryManager* getExceptionMemoryManager() override;

    std::size_t bytes_in_use() const { return in_use_; }
    std::size_t bytes_kept() const { return kept_; }

private:
    struct Header;
    static constexpr std::size_t smallest = 32;

    std::array<Header*, 48> free_{};  // by the power of two above `smallest`
    std::size_t in_use_ = 0;
    std::size_t kept_ = 0;
};

}  // namespace rois::xml
