// A study whose stimuli are all one constant image. The times and answers of its database do not depend on the images.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

#include "database/disk/study_folder.h"
#include "protocols/orders/counterbalancing.h"

namespace study::bench {

/// Makes the study in the new folder `path`, with this design and without a passphrase; no participant has begun.
database::StudyFolder makeConstantStudy(const std::filesystem::path& path, const std::string& protocolJson,
                                        protocols::Design (*draw)(const protocols::Protocol&), const cv::Mat& image);

/// The same with a balanced design and images of one pixel.
database::StudyFolder makeConstantStudy(const std::filesystem::path& path, const std::string& protocolJson);

}  // namespace study::bench
