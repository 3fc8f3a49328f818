// SPDX-License-Identifier: MIT
// malloc for small modules: free blocks in one list by address, first fit, neighbours joined on free. It has
// an eighth of the code size of the library's malloc. It is slower with thousands of free blocks, which never
// occur here. One thread.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

// The end of the linker's data.
extern "C" unsigned char __heap_base;

namespace {

constexpr std::size_t kAlign = 16, kPage = 65536;

// Header of every block. Free blocks use all of it.
struct alignas(kAlign) Block {
    std::size_t bytes;  // including this header
    Block* next;        // of a free block
};
static_assert(sizeof(Block) == kAlign);

Block* first_free = nullptr;
std::uintptr_t end = 0;  // of the memory in use

std::uintptr_t place_of(const Block* block) {
    return reinterpret_cast<std::uintptr_t>(block);
}
Block* block_at(std::uintptr_t place) {
    return reinterpret_cast<Block*>(place);
}

void join(Block* a) {
    if (a->next == nullptr || place_of(a) + a->bytes != place_of(a->next)) return;
    a->bytes += a->next->bytes;
    a->next = a->next->next;
}

void give_back(Block* block) {
    Block* before = nullptr;
    Block* after = first_free;
    while (after != nullptr && after < block) {
        before = after;
        after = after->next;
    }
    block->next = after;
    if (before == nullptr) {
        first_free = block;
    } else {
        before->next = block;
    }
    join(block);
    if (before != nullptr) join(before);
}

bool grow(std::size_t bytes) {
    if (end == 0) end = (reinterpret_cast<std::uintptr_t>(&__heap_base) + kAlign - 1) / kAlign * kAlign;
    const std::uintptr_t has = __builtin_wasm_memory_size(0) * kPage;
    if (bytes > UINTPTR_MAX - kPage - end) return false;
    if (end + bytes > has) {
        if (__builtin_wasm_memory_grow(0, (end + bytes - has + kPage - 1) / kPage) == SIZE_MAX) return false;
    }
    Block* block = block_at(end);
    block->bytes = __builtin_wasm_memory_size(0) * kPage - end;
    end += block->bytes;
    give_back(block);
    return true;
}

// Returns a block aligned to `alignment`, a power of two >= kAlign.
void* take(std::size_t bytes, std::size_t alignment) {
    if (bytes > PTRDIFF_MAX - alignment - 2 * kPage) return nullptr;
    bytes = (bytes + kAlign - 1) / kAlign * kAlign + sizeof(Block);
    for (int attempt = 0; attempt < 2; ++attempt) {
        Block** link = &first_free;
        for (Block* block = first_free; block != nullptr; link = &block->next, block = block->next) {
            const std::uintptr_t content =
                (place_of(block) + sizeof(Block) + alignment - 1) / alignment * alignment;
            const std::size_t ahead = content - sizeof(Block) - place_of(block);
            if (block->bytes < ahead + bytes) continue;
            Block* taken = block_at(content - sizeof(Block));
            Block* after = block->next;
            const std::size_t rest = block->bytes - ahead - bytes;
            taken->bytes = bytes + (rest > sizeof(Block) ? 0 : rest);
            if (rest > sizeof(Block)) {
                Block* left = block_at(place_of(taken) + bytes);
                left->bytes = rest;
                left->next = after;
                after = left;
            }
            if (ahead > 0) {
                block->bytes = ahead;
                block->next = after;
            } else {
                *link = after;
            }
            return block_at(content);
        }
        if (!grow(bytes + alignment)) return nullptr;
    }
    return nullptr;
}

}  // namespace

extern "C" void* malloc(std::size_t bytes) {
    return take(bytes, kAlign);
}
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
    return take(bytes, alignment < kAlign ? kAlign : alignment);
}
extern "C" void free(void* memory) {
    if (memory != nullptr) give_back(static_cast<Block*>(memory) - 1);
}
