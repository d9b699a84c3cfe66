// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/paged_array.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <string>

#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::core {
namespace {

using Complex = std::complex<float>;

// Maps a file without a name that exists as long as the mapping.
Complex* map_file(std::size_t bytes, const std::filesystem::path& folder) {
    const auto fail = [&](const std::string& what, int reason) {
        throw Error(ErrorCode::cannot_write,
                    fmt::format("{} of {} in '{}': {}", what, format_bytes(static_cast<double>(bytes)), folder.string(),
                                std::strerror(reason)));
    };
    const int file = open_unnamed(folder);
    if (file < 0) fail("cannot create a scratch file", errno);
    // Reserves disk space now, because a full disk under a mapping would kill the program.
    const int reserve_error = posix_fallocate(file, 0, static_cast<off_t>(bytes));
    void* data = reserve_error == 0 ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
    const int reason = reserve_error != 0 ? reserve_error : errno;
    close(file);
    if (data == MAP_FAILED) fail("no room for a scratch file", reason);
    return static_cast<Complex*>(data);
}

}  // namespace

void PagedArray::Release::operator()(Complex* data) const {
    if (mapped_bytes > 0)
        munmap(data, mapped_bytes);
    else
        CacheLineAllocator<Complex>().deallocate(data, 0);
}

PagedArray::PagedArray(const Shape<2>& shape, const ScratchOptions& scratch, Contents contents) : shape_(shape) {
    constexpr std::size_t max_samples = std::numeric_limits<std::size_t>::max() / (4 * sizeof(Complex));
    if (shape[0] == 0 || shape[1] == 0 || shape[0] > max_samples / shape[1])
        throw Error(ErrorCode::usage, fmt::format("cannot create an array of {}x{} samples", shape[1], shape[0]));
    const std::size_t bytes = count(shape) * sizeof(Complex);
    if (bytes <= scratch.memory) {
        data_ = {CacheLineAllocator<Complex>().allocate(count(shape)), Release()};
        if (contents == Contents::zero) std::fill_n(data_.get(), count(shape), Complex(0));
    } else if (!scratch.folder.empty()) {
        data_ = {map_file(bytes, scratch.folder), Release(bytes)};
    } else {
        throw Error(ErrorCode::usage,
                    fmt::format("an array of {}x{} samples takes {}, more than the {} allowed in memory; name a folder "
                                "for scratch files",
                                shape[1], shape[0], format_bytes(static_cast<double>(bytes)),
                                format_bytes(static_cast<double>(scratch.memory))));
    }
}

}  // namespace hogel::core
