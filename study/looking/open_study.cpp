#include "study/looking/open_study.h"

#include "database/study_store.h"
#include "protocols/files/errors.h"

namespace study::looking {

namespace {

namespace fs = std::filesystem;

protocols::Error blinded(const fs::path& place, const fs::path& study)
{
    return protocols::badInput({"is part of a study that is not unblinded, so nobody may view it", place.string(),
                                "a file outside " + study.string(),
                                "view the data set of the study, or unblind the study when it is over"});
}

bool isUnblinded(const fs::path& study)
{
    try {
        return database::StudyStore({study}, database::StudyStore::Access::Read).unblinding().has_value();
    } catch (const protocols::Error&) {
        return false;  // a study that cannot be read must count as blinded
    }
}

}  // namespace

void requireNotOfOpenStudy(const fs::path& place)
{
    std::error_code problem;
    const fs::path whole = fs::weakly_canonical(place, problem);
    for (fs::path folder = whole; !folder.empty(); folder = folder.parent_path()) {
        if (fs::exists(folder / "study.db", problem) && !isUnblinded(folder)) throw blinded(place, folder);
        if (folder == folder.root_path()) return;
    }
}

}  // namespace study::looking
