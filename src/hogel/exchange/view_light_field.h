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

/// Light field of a set of views: a pixel is a hogel, a camera is a direction. Sample k of U is the ray that goes to
/// the right behind the hologram, which a viewpoint on the left sees. Therefore camera column c maps to k = n - 1 - c,
/// and camera row r (from the top) to l = n - 1 - r. The mapping k = c would be pseudoscopic.
///
/// Views that do not fit into memory are read in bands of rows. Without a spool folder, each band decodes every picture
/// again. With one, the first read decodes every picture once into a spool file, in its memory format. The file is
/// unnamed, so that it disappears with the process.
class ViewLightField final : public LightFieldSource {
  public:
    /// @param memory  bytes of pictures held at any time
    /// @param spool   folder of the spool file; empty: no spool file
    ViewLightField(ViewSet set, const Placement& placement, Transfer transfer, double memory,
                   std::filesystem::path spool);

    /// Adds depth, from the disparity of the set's own views before densification.
    void set_depth(std::shared_ptr<const Disparities> disparities, std::size_t densified, double shear);

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return disparities_ != nullptr; }
    /// Full-width rows, no higher than a band.
    HogelRange preferred_tile() const override;
    void read(LightFieldTile& tile) const override;

    std::size_t band_rows() const { return band_rows_; }
    /// Size of the spool file, bytes; 0 if all rows fit into memory.
    double spool_bytes() const;

  private:
    // Rows of all views, as stored: views[row * columns + column] is [y][x][c].
    struct Band {
        std::size_t first = 0, count = 0;
        std::vector<image::Samples> views;
        std::vector<std::shared_ptr<const DisparityMap>> maps;  // empty without depth
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
    double disparity_on_hologram_ =
        0;  // disparity of points on the hologram, between neighbouring views of the set, pixels
    std::filesystem::path spool_folder_;
    std::vector<float> table8_, table16_;
    std::size_t band_rows_ = 1;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const Band> band_;
    mutable std::unique_ptr<core::RawFile> spool_;  // guarded by mutex_ until it is filled
};

}  // namespace hogel::exchange
