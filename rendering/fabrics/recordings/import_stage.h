// An import that becomes visible only as a whole: its files are written into a draft and moved into the data set by
// commit(). Without it they vanish. All files are written with Sync::Later.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocols/files/folder_draft.h"
#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

class ImportStage {
public:
    /// Opens the data set at `out` or begins a new one. Throws badInput where `out` is something else.
    explicit ImportStage(const std::filesystem::path& out);

    Dataset& dataset() { return m_dataset; }
    bool isNew() const { return m_isNew; }

    /// The fabric of that name, or a new one under the next free id. `wanted` sets the id.
    protocols::FabricId fabricFor(const std::string& name, const std::optional<protocols::FabricId>& wanted);

    struct Slot {
        int index;
        std::filesystem::path file;  ///< write the sample here
    };
    /// The next sample of a fabric and signal; its place stays unknown and it is a group of its own.
    Slot addSample(const protocols::FabricId& fabric, Modality modality);

    /// Where to write a file about a sample, beside it and under its name: "000.json".
    std::filesystem::path beside(const Slot& slot, const std::string& ending);

    /// A picture for the user, not of the data set: written by the caller once all is in place.
    struct Plot {
        std::string name, svg;
    };
    void keepPlot(Plot plot) { m_plots.push_back(std::move(plot)); }
    const std::vector<Plot>& plots() const { return m_plots; }

    /// Where to write a file that belongs to the whole data set.
    std::filesystem::path addFile(const std::string& name);

    /// Moves everything into the data set; dataset.json last. Throws environmentFault.
    void commit();

private:
    std::filesystem::path m_out;
    bool m_isNew;
    Dataset m_dataset;
    protocols::FolderDraft m_draft;
    std::vector<SamplePlace> m_added;
    std::vector<Plot> m_plots;
};

}  // namespace rendering::fabrics
