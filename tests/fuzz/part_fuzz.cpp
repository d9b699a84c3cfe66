// SPDX-License-Identifier: Apache-2.0
// Part files, which are joined with themselves alone, and the records of checkpoints.
#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>

#include "fuzz_file.h"
#include "hogel/pipeline.h"
#include "hogel/work/checkpoint_file.h"

namespace {

using namespace hogel;

// Puts the checksums of records right, up to one whose lengths are not those of the file.
void repair(std::uint8_t* data, std::size_t size) {
    constexpr std::string_view before = "\nrecords\n";
    std::string_view file(reinterpret_cast<const char*>(data), size);
    const std::size_t begin = file.find(before);
    if (begin == std::string_view::npos) return;
    constexpr std::size_t head = work::checkpoint_record_head_bytes(0);
    for (std::size_t at = begin + before.size(); size - at >= head;) {
        std::uint64_t lengths[2];
        std::memcpy(lengths, data + at + 8, sizeof lengths);
        const std::size_t rest = size - at - head;
        if (lengths[0] > rest / 8 || lengths[1] > rest - 8 * lengths[0]) return;
        std::vector<std::uint64_t> key(lengths[0]);
        if (!key.empty()) std::memcpy(key.data(), data + at + head, 8 * key.size());
        const std::size_t bytes = at + head + 8 * key.size();
        std::memcpy(data + at, work::checkpoint_record_head(key, file.substr(bytes, lengths[1])).data(), 8);
        at = bytes + lengths[1];
    }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

// Nearly all changes are seen by checksums. So these are put right, except in one case of sixteen.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    const std::size_t changed = LLVMFuzzerMutate(data, size, max_size);
    if (seed % 16 != 0) repair(data, changed);
    return changed;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::FuzzFile file(data, size, ".part");
    const std::filesystem::path joined = file.path().string() + ".h5";
    fuzz::expect_bad_input([&] { join_parts(joined, {&file.path(), 1}); });
    std::filesystem::remove(joined);
    fuzz::expect_bad_input([&] {
        work::CheckpointReader reader(file.path(), "checkpoint");
        while (reader.read()) {
        }
    });
    return 0;
}
