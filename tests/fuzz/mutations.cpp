// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target without libFuzzer: over every file of a folder, then over mutations of them that are the same in
// every run.
//
// usage: NAME_mutations FOLDER COUNT [FIRST]
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" {
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
/// A target may have its own mutations, which call LLVMFuzzerMutate().
__attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                                          unsigned seed);
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
}

namespace {

std::minstd_rand generator;

// A whole number below n.
std::size_t below(std::size_t n) { return n == 0 ? 0 : generator() % n; }

using Bytes = std::vector<std::uint8_t>;

std::vector<Bytes> read_all(const char* folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
    std::ranges::sort(paths);
    std::vector<Bytes> files;
    for (const auto& path : paths) {
        std::ifstream in(path, std::ios::binary);
        files.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return files;
}

// What was being done when the program crashed.
char doing[160];
void tell(int signal) {
    // Nothing can be done if this fails.
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, doing, std::strlen(doing));
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

bool run(const Bytes& bytes, std::size_t number, const char* what) {
    std::snprintf(doing, sizeof doing, "failed on %s %zu\n", what, number);
    try {
        LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
        return true;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s", error.what(), doing);
        return false;
    }
}

}  // namespace

// Changes a number in one place: a bit, a byte, a word of 16, 32 or 64 bits, a copy of other bytes, the end.
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size) {
    if (size == 0) return 0;
    const std::size_t at = below(size), left = size - at;
    const auto put = [&](std::uint64_t value, std::size_t bytes) {
        std::memcpy(data + at, &value, std::min(bytes, left));
    };
    constexpr std::uint64_t edges[] = {0, 1, 2, 0x7f, 0xff, 0x7fff, 0xffff, 0x7fffffff, 0xffffffff, ~std::uint64_t{0}};
    switch (below(8)) {
        case 0:
        case 1:
            data[at] ^= static_cast<std::uint8_t>(1u << below(8));
            break;
        case 2:
            data[at] = static_cast<std::uint8_t>(generator());
            break;
        case 3:
            put(edges[below(std::size(edges))], std::size_t{1} << below(4));
            break;
        case 4:
            data[at] = static_cast<std::uint8_t>(data[at] + (below(2) == 0 ? 1 : 255));
            break;
        case 5:
            if (const std::size_t from = below(size); from != at)
                std::memmove(data + at, data + from, std::min({left, size - from, 1 + below(16)}));
            break;
        case 6:  // the end is lost
            return at + 1;
        default:  // bytes are inserted
            const std::size_t more = std::min(1 + below(8), max_size - size);
            std::memmove(data + at + more, data + at, left);
            return size + more;
    }
    return size;
}

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    const std::vector<Bytes> seeds = read_all(argv[1]);
    const std::size_t count = std::strtoull(argv[2], nullptr, 10),
                      first = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 0;
    if (seeds.empty()) {
        std::fprintf(stderr, "no files in %s\n", argv[1]);
        return 1;
    }
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, tell);
    for (std::size_t i = 0; i < seeds.size(); ++i)
        if (!run(seeds[i], i, "seed")) return 1;
    for (std::size_t i = first; i < first + count; ++i) {
        generator.seed(static_cast<unsigned>(i + 1));
        below(2);
        Bytes bytes = seeds[i % seeds.size()];
        std::size_t size = bytes.size();
        bytes.resize(size + 64);
        for (std::size_t n = 1 + below(4); n > 0; --n)
            size = LLVMFuzzerCustomMutator != nullptr
                       ? LLVMFuzzerCustomMutator(bytes.data(), size, bytes.size(), static_cast<unsigned>(generator()))
                       : LLVMFuzzerMutate(bytes.data(), size, bytes.size());
        bytes.resize(size);
        if (!run(bytes, i, "mutation")) return 1;
    }
    std::printf("%zu seeds and %zu mutations of them\n", seeds.size(), count);
    return 0;
}
