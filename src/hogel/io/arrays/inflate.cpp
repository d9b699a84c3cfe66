// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/arrays/inflate.h"

#include <zlib.h>

#include <algorithm>

#include "hogel/core/stop_scope.h"
#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {
namespace {

struct Stream : z_stream {
    // zlib's format, or raw data if `bits` is negative.
    explicit Stream(int bits = MAX_WBITS) : z_stream{} { started = inflateInit2(this, bits) == Z_OK; }
    ~Stream() {
        if (started) inflateEnd(this);
    }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    bool started = false;
};

bool inflate_first(std::span<const unsigned char> packed, std::span<unsigned char> plain) {
    Stream stream;
    if (!stream.started) return false;
    stream.next_in = const_cast<unsigned char*>(packed.data());
    stream.avail_in = static_cast<unsigned>(packed.size());
    for (std::size_t from = 0; from < plain.size();) {
        stream.next_out = &plain[from];
        stream.avail_out = static_cast<unsigned>(std::min<std::size_t>(plain.size() - from, 1u << 30));
        const unsigned wanted = stream.avail_out;
        const int status = ::inflate(&stream, Z_NO_FLUSH);
        from += wanted - stream.avail_out;
        if (status == Z_STREAM_END ? from < plain.size() : status != Z_OK) return false;
    }
    return true;
}

bool inflate_all(Stream& stream, std::span<const unsigned char> packed, std::span<unsigned char> plain) {
    if (!stream.started) return false;
    for (std::size_t from = 0, to = 0;;) {
        core::throw_if_stopped();
        const std::size_t in = std::min(packed.size() - from, bytes_between_checks),
                          out = std::min(plain.size() - to, bytes_between_checks);
        stream.next_in = const_cast<unsigned char*>(packed.data() + from);
        stream.avail_in = static_cast<unsigned>(in);
        stream.next_out = plain.data() + to;
        stream.avail_out = static_cast<unsigned>(out);
        const int status = ::inflate(&stream, Z_NO_FLUSH);
        from += in - stream.avail_in;
        to += out - stream.avail_out;
        if (status == Z_STREAM_END) return to == plain.size();
        if (status != Z_OK || (in == stream.avail_in && out == stream.avail_out)) return false;
    }
}

}  // namespace

bool inflate(const std::filesystem::path&, std::span<const unsigned char> packed, std::span<unsigned char> plain,
             Extent extent) {
    if (extent == Extent::first) return inflate_first(packed, plain);
    Stream stream;
    return inflate_all(stream, packed, plain);
}

bool inflate_bare(const std::filesystem::path&, std::span<const unsigned char> packed, std::span<unsigned char> plain) {
    Stream stream(-MAX_WBITS);
    return inflate_all(stream, packed, plain);
}

}  // namespace hogel::io::arrays
