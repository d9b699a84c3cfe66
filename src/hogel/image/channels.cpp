// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/channels.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <new>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/image/picture_bytes.h"

namespace hogel::image {

NamedChannels read_named_channels(const std::filesystem::path& path, bool only_names) {
    PictureBytes file{{}, path.string(), std::size_t{1} << 28, only_names};
    std::ifstream stream(path, std::ios::binary);
    if (!stream) file.fail("it cannot be opened");
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    file.bytes = {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()};
    return guarded(file, [&] {
        ExrChannels read = read_exr_channels(file);
        return NamedChannels{std::move(read.channels), std::move(read.texts)};
    });
}

void write_named_channels(const std::filesystem::path& path, NamedChannels picture) {
    core::require_target(path);
    try {
        core::write_file(path, exr_channels_file({std::move(picture.channels), std::move(picture.texts)}));
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorCode::cannot_write,
                    fmt::format("cannot write '{}': {}", path.string(), one_line(error.what())));
    }
}

}  // namespace hogel::image
