// What will be computed for a whole study, as counts: `study new --explain` prints it before the work.
#pragma once

#include <string>

#include "study/making/study_material.h"

namespace study::making {

/// Lines of counts: recordings, signals, networks, images and bytes. Names no sample, and no fabric beside a condition.
std::string plannedWork(const StudyMaterial& material);

}  // namespace study::making
