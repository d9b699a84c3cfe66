// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>

#include "view/viewable.h"
#include "view/waves.h"

namespace hogel::view {

/// Light field with its samples in memory, in the order in which viewpoints read them.
class LightFieldViewable final : public Viewable {
  public:
    /// Reads `shown`, which is `light_field` or a subset of its hogels; readings come from `light_field` itself.
    /// @param waves  photographs by waves of its holograms; null for a preview
    LightFieldViewable(LightField light_field, LightField shown, std::size_t memory, const Progress& progress,
                       std::unique_ptr<Waves> waves = {});

    /// Shares the samples of another light field, with other holograms.
    LightFieldViewable(const LightFieldViewable& other, std::unique_ptr<Waves> waves);

    const LightField& light_field() const { return light_field_; }
    const LightFieldGrid& grid() const { return light_field_.grid(); }
    const LightFieldGrid& shown() const { return rays_->shown; }

    /// Replaces the automatic exposure.
    void set_exposure(double exposure) { exposure_ = exposure; }
    /// Sets the uncompressed light field for comparisons. Its samples are read when a picture first needs them.
    /// Must be called before this viewable is shown.
    void set_original(LightField original);
    /// Sets the compressed size of each hogel in bytes, [t][s]; an empty array: unknown.
    void set_bytes_of_hogels(Array<double, 2> bytes);

    double width() const override { return grid().width(); }
    double height() const override { return grid().height(); }
    bool has_rays() const override { return true; }
    bool has_original() const override { return original_ != nullptr; }
    std::size_t looks() const override { return waves_ ? waves_->looks() : 0; }
    nlohmann::ordered_json facts() const override;
    double exposure() const override { return exposure_; }
    Reading read(const PictureQuery& query, const PickPoint& point) const override;
    /// Returns the stored depth, or without depth the depth at which a patch around the point is sharpest.
    double focus(const PictureQuery& query, const PickPoint& point, const Progress& progress) override;
    /// hogel: the directions of one hogel. views: parallel views of a grid of directions. s-u, t-v: epipolar plane
    /// images through the point, along a row or a column of hogels. depth: near is bright. coverage: fraction of each
    /// hogel's rays that hit something (without depth: that are not black). rate: compressed bytes of each hogel.
    Photograph inside(const PictureQuery& query, const PickPoint& point, const InsideQuery& inside,
                      const Progress& progress) override;

  protected:
    Image by_rays(const PictureQuery& query, const Progress& progress) override;
    void by_waves(const PictureQuery& query, std::size_t looks, const OnLooks& shown,
                  const Progress& progress) override;

  private:
    // Samples of a light field in memory, shared by viewables that differ only in their waves.
    struct Rays {
        Rays(LightField light_field, std::size_t memory, const Progress& progress)
            : shown(light_field.grid()), photographer(std::move(light_field), {.memory = memory}, progress) {}
        LightFieldGrid shown;
        std::mutex mutex;  // photographs by rays and by waves run concurrently
        RayPhotographer photographer;
    };
    // Uncompressed light field, read when first needed.
    struct Original {
        LightField light_field;
        std::size_t memory;
        std::unique_ptr<Rays> rays;
    };

    Image photograph_rays(Rays& rays, const PictureQuery& query, const Progress& progress);
    double sharpest(const PictureQuery& query, const PickPoint& point, const Progress& progress);
    Image views(const InsideQuery& inside, const Progress& progress);
    Image rates() const;

    LightField light_field_;
    std::shared_ptr<Rays> rays_;
    std::unique_ptr<Original> original_;
    std::unique_ptr<Waves> waves_;
    double exposure_ = 1;
    std::size_t memory_;
    mutable std::mutex mutex_;  // guards bytes_of_hogels_
    Array<double, 2> bytes_of_hogels_;
};

/// Number of samples of a preview: 32 MB, a few hundredths of a second from the page cache.
inline constexpr double first_look_samples = 8e6;

/// Returns the smallest odd step between hogels that leaves at most `samples` samples.
std::size_t step_for(const LightFieldGrid& grid, double samples);
/// Returns the step between hogels at which the samples, 2 bytes each, fit into `memory` bytes.
std::size_t step_that_fits(const LightFieldGrid& grid, std::size_t memory);
/// Returns the step between hogels of the preview; 1 if the light field has at most first_look_samples samples.
std::size_t step_of_first_look(const LightFieldGrid& grid);

}  // namespace hogel::view
