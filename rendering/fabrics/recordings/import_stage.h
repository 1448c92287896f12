// An import that becomes visible only as a whole. Files are written into a draft with Sync::Later. commit() moves them
// into the data set; without it they are deleted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocols/files/folder_draft.h"
#include "rendering/fabrics/sample_places.h"

namespace rendering::fabrics {

class ImportStage {
public:
    /// Opens the data set at `out` or begins a new one. Throws badInput where `out` holds something else.
    explicit ImportStage(const std::filesystem::path& out);

    Dataset& dataset() { return m_dataset; }
    bool isNew() const { return m_isNew; }

    /// Fabric of that name, or a new one with the next free id. `wanted` sets the id.
    protocols::FabricId fabricFor(const std::string& name, const std::optional<protocols::FabricId>& wanted);

    /// States the fibre of every fabric that samples were added to. Throws badInput where another fibre is stated already.
    void tellFibre(Fibre fibre);

    struct SampleSlot {
        int index;
        std::filesystem::path file;  ///< path at which the caller writes the sample
    };
    /// Reserves the next sample of a fabric and signal. Its place is unknown, and it forms its own group.
    SampleSlot addSample(const protocols::FabricId& fabric, Modality modality);

    /// The same for a photograph whose place, group, scale and light are known; the index of `place` is ignored.
    SampleSlot addPhotograph(const SamplePlace& place);
    /// Path at which the caller writes the surface that a photograph shows.
    std::filesystem::path surfaceOf(const protocols::FabricId& fabric, const SampleSlot& photograph);

    /// Path for an additional file of a sample, beside it and with its name: "000.json".
    std::filesystem::path beside(const SampleSlot& slot, const std::string& ending);

    /// A picture for the user, outside the data set; the caller writes it after commit().
    struct StrokePlot {
        std::string name, svg;
    };
    void keepPlot(StrokePlot plot) { m_plots.push_back(std::move(plot)); }
    const std::vector<StrokePlot>& plots() const { return m_plots; }

    /// Path for a file that belongs to the whole data set.
    std::filesystem::path addFile(const std::string& name);

    /// Moves all files into the data set, dataset.json last. Throws badInput, and changes nothing, where that
    /// file could not be read again. Throws environmentFault, also where another program changed the data set in between.
    void commit();

private:
    std::filesystem::path m_out;
    bool m_isNew;
    std::string m_before;  ///< samples.csv and dataset.json as they were read
    Dataset m_dataset;
    protocols::FolderDraft m_draft;
    std::vector<SamplePlace> m_added;
    std::vector<StrokePlot> m_plots;
};

}  // namespace rendering::fabrics
