// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "hogel/core/raw_file.h"
#include "hogel/exchange/disparity.h"
#include "hogel/exchange/geometry.h"
#include "hogel/light_field.h"

namespace hogel::exchange {

/// A set of views as a light field: the picture's pixel is the hogel, the camera is the direction. Sample k of U is the
/// ray that goes to the right behind the hologram, which an eye on the left sees: camera column c is k = n - 1 - c,
/// camera row r (from the top) is l = n - 1 - r. The natural mapping k = c would be pseudoscopic.
///
/// Views that do not fit into memory together are held in bands of rows. Each band decodes every picture, or, with a
/// folder for a spool file, every picture is decoded once, when the first band is read, and written there as it is held
/// in memory. The file has no name: it is gone with the light field, however the process ends.
class ViewLightField final : public LightFieldSource {
  public:
    /// @param memory  bytes of pictures held at any time
    /// @param spool   folder for the spool file; empty: none
    ViewLightField(ViewSet set, const Placement& placement, Transfer transfer, double memory,
                   std::filesystem::path spool);

    /// Gives the light field depth, by the disparity of the set's own views, between which others were put.
    void set_depth(std::shared_ptr<const Disparities> disparities, std::size_t densified, double shear);

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return disparities_ != nullptr; }
    /// Long rows, no higher than a band.
    HogelRange preferred_tile() const override;
    void read(LightFieldTile& tile) const override;

    std::size_t band_rows() const { return band_rows_; }
    /// The size of the spool file; 0 where all rows fit into memory.
    double spool_bytes() const;

  private:
    // Rows of all views, as stored: views[row * columns + column] is [y][x][c].
    struct Band {
        std::size_t first = 0, count = 0;
        std::vector<image::Samples> views;
        std::vector<std::shared_ptr<const DisparityMap>> maps;  // none without depth
    };

    bool is_whole() const;
    std::size_t sample_bytes() const;
    std::shared_ptr<const Band> band_at(std::size_t t) const;
    std::shared_ptr<const Band> load(std::size_t first) const;
    image::Samples decoded(std::size_t view, std::size_t first, std::size_t count) const;
    void check(const image::Picture& picture, std::size_t row, std::size_t column) const;
    image::Samples cut(image::Samples samples, std::size_t row, std::size_t column, std::size_t first,
                       std::size_t count) const;
    Array<float, 3> interpolated(const image::Samples& samples, double x, double y, std::size_t count) const;
    float between(const image::Samples& samples, double x, double y, std::size_t c) const;
    void fill_spool() const;
    image::Samples spooled(std::size_t view, std::size_t first, std::size_t count) const;
    void fill(LightFieldTile& tile, std::size_t j, const Band& band) const;
    void fill_depth(LightFieldTile& tile, std::size_t j, const Band& band) const;
    float depth_of(double disparity) const;
    template <class T>
    void gather(const T* from, float* to, std::size_t count) const;
    float linear(std::uint8_t code) const { return table8_[code]; }
    float linear(std::uint16_t code) const { return table16_[code]; }
    float linear(float value) const;

    ViewSet set_;
    LightFieldGrid grid_;
    Shear shear_;
    Transfer transfer_;
    std::shared_ptr<const Disparities> disparities_;
    std::size_t densified_ = 1;
    double disparity_here_ = 0;  // of what lies on the hologram, from a view of the set to the next
    std::filesystem::path spool_folder_;
    std::vector<float> table8_, table16_;
    std::size_t band_rows_ = 1;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const Band> band_;
    mutable std::unique_ptr<core::RawFile> spool_;  // under the mutex until it is filled
};

}  // namespace hogel::exchange
