// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "view/viewable.h"
#include "view/waves.h"

namespace hogel::view {

/// Hologram of one or three wavelengths: a file of hogel or a field of another program.
class HologramViewable final : public Viewable {
  public:
    /// Reads the fields into memory if their samples fit into half of `memory` bytes. Throws Error(bad_input) unless
    /// there are one or three wavelengths.
    HologramViewable(Fields fields, std::size_t memory, const Progress& progress);

    double width() const override;
    double height() const override;
    bool has_rays() const override { return false; }
    std::size_t looks() const override { return waves_->looks(); }
    nlohmann::ordered_json facts() const override;
    double exposure() const override { return exposure_; }
    Reading read(const PictureQuery& query, const PickPoint& point) const override;
    /// Returns the most prominent focus plane of the samples around the point. Throws Error(usage) if there is none.
    double focus(const PictureQuery& query, const PickPoint& point, const Progress& progress) override;
    /// intensity, phase, real: samples of a colour around the point, one per pixel. spectrum: their power spectrum over
    /// four decades, frequency zero in the middle, x to the right and y upwards.
    Photograph inside(const PictureQuery& query, const PickPoint& point, const InsideQuery& inside,
                      const Progress& progress) override;
    FocusSearch find_focus(const Progress& progress) override;
    /// Counts the levels of the first wavelength in the central 1024 × 1024 samples at most.
    LevelCounts count_levels(const std::string& encoding, const Progress& progress) override;

  protected:
    Image by_rays(const PictureQuery& query, const Progress& progress) override;
    void by_waves(const PictureQuery& query, std::size_t looks, const OnLooks& shown,
                  const Progress& progress) override;

  private:
    Field samples_around(const Reading& point, std::size_t colour, std::size_t side) const;
    FocusOptions search_options(std::size_t planes) const;
    void measure(const Progress& progress);

    Fields fields_;
    std::unique_ptr<Waves> waves_;
    double exposure_ = 1;
    double efficiency_ = 0;  // mean |F|² / max |F|²
};

}  // namespace hogel::view
