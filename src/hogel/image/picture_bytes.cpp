// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "hogel/image/picture_bytes.h"

namespace hogel::image {
namespace {

using namespace std::string_view_literals;

struct Signature {
    std::string_view bytes;
    PictureReader read;
};

constexpr std::array signatures{Signature{"\x89PNG\r\n\x1a\n"sv, read_png},
                                Signature{"\xff\xd8\xff"sv, read_jpeg},
                                Signature{"\x76\x2f\x31\x01"sv, read_exr},
                                Signature{"II*\0"sv, read_tiff},
                                Signature{"MM\0*"sv, read_tiff},
                                Signature{"GIF8"sv, read_with_stb},
                                Signature{"BM"sv, read_with_stb},
                                Signature{"#?"sv, read_with_stb},
                                Signature{"P1"sv, read_pnm},  // read_pnm() refuses P1 to P4 by name
                                Signature{"P2"sv, read_pnm},
                                Signature{"P3"sv, read_pnm},
                                Signature{"P4"sv, read_pnm},
                                Signature{"P5"sv, read_pnm},
                                Signature{"P6"sv, read_pnm},
                                Signature{"PF"sv, read_pfm},
                                Signature{"Pf"sv, read_pfm}};

std::uint32_t big_endian(std::span<const unsigned char> b) {
    return std::uint32_t{b[0]} << 24 | std::uint32_t{b[1]} << 16 | std::uint32_t{b[2]} << 8 | b[3];
}

std::uint32_t little_endian(std::span<const unsigned char> b) {
    return std::uint32_t{b[3]} << 24 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[1]} << 8 | b[0];
}

}  // namespace

// Targa 2.0: length of the identifier, palette flag, and picture type; bits per pixel at byte 16.
bool begins_like_tga(std::span<const unsigned char> bytes) {
    if (bytes.size() < 18) return false;
    const unsigned palette = bytes[1], type = bytes[2] & ~8u, depth = bytes[16];
    if ((bytes[2] & ~0xbu) != 0 || palette > 1 || type < 1 || type > 3 || (type == 1) != (palette == 1)) return false;
    return depth == 8 || ((depth == 15 || depth == 16 || depth == 24 || depth == 32) && type != 1);
}

// PNG (ISO 15948): a signature of 8 bytes, then chunks of length, name, data and checksum.
std::string png_structure_error(std::span<const unsigned char> bytes) {
    for (std::size_t offset = 8; bytes.size() - offset >= 12;) {
        const std::uint32_t length = big_endian(bytes.subspan(offset, 4));
        if (length > bytes.size() - offset - 12)
            return fmt::format("the chunk at byte {} claims {} bytes, which is beyond the end of the file", offset,
                               length);
        if (std::ranges::equal(bytes.subspan(offset + 4, 4), "IEND"sv)) return "";
        offset += std::size_t{12} + length;
    }
    return "it ends before its last chunk";
}

// OpenEXR layout: after 8 bytes one header, or several headers and an empty one. A header is a list of attributes
// (name, type, size, value) that ends with an empty name.
std::string exr_structure_error(std::span<const unsigned char> bytes) {
    if (bytes.size() < 8) return "it ends inside its header";
    const bool several = (little_endian(bytes.subspan(4, 4)) & 0x1000) != 0;
    std::size_t offset = 8;
    bool empty_header = true;
    const auto skip_text = [&] {
        const auto end = std::ranges::find(bytes.subspan(offset), 0);
        const auto length = static_cast<std::size_t>(end - bytes.begin()) - offset;
        offset += length + 1;
        return length;
    };
    while (offset < bytes.size()) {
        const std::size_t attribute = offset;
        if (skip_text() == 0) {
            if (!several || empty_header) return "";
            empty_header = true;
            continue;
        }
        empty_header = false;
        if (offset < bytes.size()) skip_text();
        if (offset >= bytes.size() || bytes.size() - offset < 4) break;
        const std::uint32_t length = little_endian(bytes.subspan(offset, 4));
        offset += 4;
        if (length > bytes.size() - offset)
            return fmt::format("the attribute at byte {} claims {} bytes, which is beyond the end of the file",
                               attribute, length);
        offset += length;
    }
    return "it ends inside its header";
}

std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
    std::string line;
    for (const char c : text) {
        if (static_cast<unsigned char>(c) >= ' ')
            line += c;
        else if (!line.ends_with(' '))
            line += ' ';
    }
    return line.empty() ? "unknown reason" : line;
}

void fail_write(const std::string& what, const std::string& why) {
    throw Error(ErrorCode::cannot_write, fmt::format("cannot write {}: {}", what, one_line(why)));
}

PictureReader picture_reader(std::span<const unsigned char> bytes) {
    const std::string_view start(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), beginning));
    if (start.starts_with("RIFF"sv) && start.substr(std::min<std::size_t>(start.size(), 8)).starts_with("WEBP"sv))
        return read_webp;
    for (const Signature& signature : signatures)
        if (start.starts_with(signature.bytes)) return signature.read;
    return begins_like_tga(bytes) ? read_with_stb : nullptr;
}

}  // namespace hogel::image
