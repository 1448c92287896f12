// Pictures as tensors, and the eight symmetries of the square. Only the torch sources include it.
#pragma once

#include <torch/torch.h>

#include <opencv2/core/mat.hpp>

namespace rendering::models {

/// A picture CV_8UC3 as [1, 3, H, W] in 0 to 1.
inline torch::Tensor tensorOfPicture(const cv::Mat& rgb)
{
    const cv::Mat whole = rgb.isContinuous() ? rgb : rgb.clone();
    const torch::Tensor bytes = torch::from_blob(whole.data, {whole.rows, whole.cols, 3}, torch::kByte);
    return (bytes.permute({2, 0, 1}).to(torch::kFloat) / 255).unsqueeze(0).contiguous();
}

/// One of the eight symmetries of the square: bit 0 mirrors columns, bit 1 rows, bit 2 swaps both axes.
inline torch::Tensor turned(torch::Tensor image, int turn)
{
    if ((turn & 4) != 0) image = image.transpose(2, 3);
    if ((turn & 1) != 0) image = image.flip({3});
    if ((turn & 2) != 0) image = image.flip({2});
    return image.contiguous();
}

inline torch::Tensor turnedBack(torch::Tensor image, int turn)
{
    if ((turn & 1) != 0) image = image.flip({3});
    if ((turn & 2) != 0) image = image.flip({2});
    if ((turn & 4) != 0) image = image.transpose(2, 3);
    return image.contiguous();
}

}  // namespace rendering::models
