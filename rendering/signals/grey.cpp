#include "rendering/signals/grey.h"

#include <opencv2/core.hpp>
#include <string>

#include "protocols/files/errors.h"

namespace rendering::signals {

cv::Mat grey(const cv::Mat& image)
{
    if (image.empty() || (image.channels() != 3 && image.channels() != 1))
        throw protocols::badInput({.what = "an image with " + std::to_string(image.channels()) + " channels and " +
                                           std::to_string(image.total()) + " pixels cannot be converted to grey",
                                   .where = "",
                                   .expected = "one channel, or red, green and blue",
                                   .nextStep = "export the image as RGB or grey"});
    cv::Mat values;
    image.convertTo(values, CV_32F);
    if (values.channels() == 1) return values;
    // A matrix product, because cvtColor would round 8-bit input to whole grey levels.
    cv::Mat result;
    cv::transform(values, result, cv::Matx13f(0.299F, 0.587F, 0.114F));
    return result;
}

}  // namespace rendering::signals
