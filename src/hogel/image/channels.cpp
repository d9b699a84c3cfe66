// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/channels.h"

#include <fmt/format.h>

#include "hogel/core/output_file.h"
#include "hogel/image/picture_bytes.h"

namespace hogel::image {

NamedChannels read_named_channels(const std::filesystem::path& path, bool only_names) {
    PictureBytes file{{}, path.string(), std::size_t{1} << 28, only_names};
    const std::vector<unsigned char> bytes = bytes_of_file(path, file);
    file.bytes = bytes;
    return guarded(file, [&] {
        ExrChannels read = read_exr_channels(file);
        return NamedChannels{std::move(read.channels), std::move(read.texts)};
    });
}

void write_named_channels(const std::filesystem::path& path, NamedChannels picture) {
    core::require_target(path);
    core::write_file(path, guarded_write(fmt::format("'{}'", path.string()), [&] {
                         return exr_channels_file({std::move(picture.channels), std::move(picture.texts)});
                     }));
}

}  // namespace hogel::image
