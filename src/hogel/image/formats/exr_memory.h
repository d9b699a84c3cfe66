// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfIO.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace hogel::image {

/// The bytes of an EXR file in memory, for OpenEXR to read.
class ExrSource : public Imf::IStream {
  public:
    ExrSource(std::span<const unsigned char> bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
    bool read(char into[], int size) override {
        if (size < 0 || static_cast<std::size_t>(size) > bytes_.size() - at_)
            throw std::runtime_error("it ends too early");
        std::memcpy(into, bytes_.data() + at_, static_cast<std::size_t>(size));
        at_ += static_cast<std::size_t>(size);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t to) override {
        if (to > bytes_.size()) throw std::runtime_error("it refers to what is beyond its end");
        at_ = to;
    }

  private:
    std::span<const unsigned char> bytes_;
    std::size_t at_ = 0;
};

/// The bytes of an EXR file that OpenEXR writes.
class ExrSink : public Imf::OStream {
  public:
    ExrSink() : OStream("memory") {}
    void write(const char from[], int size) override {
        const auto end = at_ + static_cast<std::size_t>(size);
        if (end > bytes.size()) bytes.resize(end);
        std::memcpy(bytes.data() + at_, from, static_cast<std::size_t>(size));
        at_ = end;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t to) override { at_ = to; }

    std::vector<unsigned char> bytes;

  private:
    std::size_t at_ = 0;
};

}  // namespace hogel::image
