// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lightwell {

/// The largest step of a picture that is not seen, in units of the value encoded for a screen (sRGB, 0 to 1), where the
/// values around it have a standard deviation of `contrast`: 1/255 where it is smooth, and up to 6/255 where contrast
/// masks it.
///
/// Smooth: on an sRGB screen of 200 cd/m2 that reflects 1 cd/m2 of its surroundings a step of 1/255 is between 1.2 and
/// 2.7 just noticeable differences everywhere (DICOM PS3.14, Grayscale Standard Display Function), so that at no value
/// a screen has a smaller step that would be seen less. Masked: the threshold rises as max(1, (contrast / c0)^0.62), c0
/// = 2/255 (Legge and Foley, Contrast Masking in Human Vision, Journal of the Optical Society of America 70, 1980).
float permitted_difference(float contrast);

}  // namespace lightwell
