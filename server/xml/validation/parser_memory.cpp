#include "xml/validation/parser_memory.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <new>
#include <utility>
#include <xercesc/util/OutOfMemoryException.hpp>
#include <xercesc/util/PlatformUtils.hpp>

namespace rois::xml {

struct alignas(std::max_align_t) ParserMemory::Header {
    std::size_t power = 0;
    Header* next = nullptr;
};

ParserMemory::~ParserMemory() {
    for (auto* block : free_) {
        while (block != nullptr) std::free(std::exchange(block, block->next));
    }
}

void* ParserMemory::allocate(XMLSize_t size) {
    auto const needed = std::bit_ceil(std::max(smallest, static_cast<std::size_t>(size) + sizeof(Header)));
    auto const power = static_cast<std::size_t>(std::countr_zero(needed) - std::countr_zero(smallest));
    in_use_ += needed;
    if (auto* const block = free_[power]) {
        free_[power] = block->next;
        kept_ -= needed;
        return block + 1;
    }
    void* const fresh = std::malloc(needed);
    if (fresh == nullptr) throw xercesc::OutOfMemoryException();
    return new (fresh) Header{power, nullptr} + 1;
}

void ParserMemory::deallocate(void* block) {
    if (block == nullptr) return;
    auto* const header = static_cast<Header*>(block) - 1;
    in_use_ -= smallest << header->power;
    kept_ += smallest << header->power;
    header->next = std::exchange(free_[header->power], header);
}

xercesc::MemoryManager* ParserMemory::getExceptionMemoryManager() { return xercesc::XMLPlatformUtils::fgMemoryManager; }

}  // namespace rois::xml
