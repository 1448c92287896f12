#include "study/session/preparation.h"

namespace study::session {

namespace {

struct NextEvent {
    const protocols::Protocol& protocol;

    template <class Stage>
    std::optional<EventBody> operator()(const Stage&) const
    {
        return std::nullopt;
    }
    std::optional<EventBody> operator()(const Enrolled&) const { return Begun{}; }
    std::optional<EventBody> operator()(const Consenting&) const { return Consented{}; }
    std::optional<EventBody> operator()(const AskingFacts&) const { return FactsGiven{}; }
    std::optional<EventBody> operator()(const Familiarising&) const { return FamiliarisationDone{}; }
    std::optional<EventBody> operator()(const ScaleTraining&) const { return ScaleTrainingDone{}; }
    std::optional<EventBody> operator()(const CheckingList&) const { return ChecklistDone{protocol.checklist, {}}; }
    std::optional<EventBody> operator()(const OnBreak&) const { return BreakEnded{}; }
    std::optional<EventBody> operator()(const Debriefing&) const { return Debriefed{}; }
};

}  // namespace

std::optional<EventBody> nextOfPreparation(const protocols::Protocol& protocol, const Stage& stage)
{
    return std::visit(NextEvent{protocol}, stage);
}

TrayReady trayReadyOf(const protocols::Protocol& protocol, const std::vector<protocols::FabricId>& tray, const PieceNames& names)
{
    TrayReady ready;
    if (!protocol.confirmPieces) return ready;
    for (const protocols::FabricId& fabric : tray) ready.pieces.push_back(nameIn(names, fabric));
    return ready;
}

}  // namespace study::session
