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

/// An EXR file in memory, as input for OpenEXR.
class ExrSource : public Imf::IStream {
  public:
    ExrSource(std::span<const unsigned char> bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
    bool read(char into[], int size) override {
        if (size < 0 || static_cast<std::size_t>(size) > bytes_.size() - offset_)
            throw std::runtime_error("it ends too early");
        std::memcpy(into, bytes_.data() + offset_, static_cast<std::size_t>(size));
        offset_ += static_cast<std::size_t>(size);
        return offset_ < bytes_.size();
    }
    std::uint64_t tellg() override { return offset_; }
    void seekg(std::uint64_t to) override {
        if (to > bytes_.size()) throw std::runtime_error("it refers to an offset beyond its end");
        offset_ = to;
    }

  private:
    std::span<const unsigned char> bytes_;
    std::size_t offset_ = 0;
};

/// An EXR file in memory, as output of OpenEXR.
class ExrSink : public Imf::OStream {
  public:
    ExrSink() : OStream("memory") {}
    void write(const char from[], int size) override {
        const auto end = offset_ + static_cast<std::size_t>(size);
        if (end > bytes.size()) bytes.resize(end);
        std::memcpy(bytes.data() + offset_, from, static_cast<std::size_t>(size));
        offset_ = end;
    }
    std::uint64_t tellp() override { return offset_; }
    void seekp(std::uint64_t to) override { offset_ = to; }

    std::vector<unsigned char> bytes;

  private:
    std::size_t offset_ = 0;
};

}  // namespace hogel::image
