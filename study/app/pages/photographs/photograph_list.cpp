#include "study/app/pages/photographs/photograph_list.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QSignalBlocker>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <set>

#include "protocols/files/id_rule.h"
#include "study/app/language/below.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

namespace fs = std::filesystem;

enum PhotographColumn { fabricColumn, fileColumn, sizeColumn, checkColumn, photographColumns };

QString textOf(const std::string& text) { return QString::fromStdString(text); }

}  // namespace

PhotographList::PhotographList(QWidget* parent)
    : QWidget(parent),
      m_byFile(button("byFileButton", tr("Each file is a fabric"), this)),
      m_byFolder(button("byFolderButton", tr("Each folder is a fabric"), this)),
      m_list(new QTreeWidget(this)),
      m_count(label("photographCount", Type::Body, this, Weight::Bold)),
      m_nameCaption(quietLabel("fabricNameCaption", this)),
      m_name(field("fabricNameField", tr("Name of the fabric"), this)),
      m_remove(button("removePhotographButton", tr("Remove the photograph (Del)"), this)),
      m_message(new MessageBar("fabricNameMessage", this))
{
    build();
    connect(m_byFile, &QPushButton::clicked, this, [this] { group(false); });
    connect(m_byFolder, &QPushButton::clicked, this, [this] { group(true); });
    connect(m_list, &QTreeWidget::currentItemChanged, this, &PhotographList::choose);
    connect(m_name, &QLineEdit::textEdited, this, &PhotographList::rename);
    connect(m_remove, &QPushButton::clicked, this, &PhotographList::removeChosen);
    list({});
}

void PhotographList::build()
{
    for (QPushButton* rule : {m_byFile, m_byFolder}) rule->setCheckable(true);
    m_byFile->setChecked(true);
    name(*m_list, "photographs", tr("Photographs"));
    setType(*m_list, Type::Plain);
    m_list->setRootIsDecorated(false);
    m_list->setAllColumnsShowFocus(true);
    m_list->setHeaderLabels({tr("Fabric"), tr("Photograph"), tr("Size, px"), tr("Check")});
    m_list->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_list->header()->setStretchLastSection(false);
    m_list->header()->setSectionResizeMode(fileColumn, QHeaderView::Stretch);
    m_list->header()->setFocusPolicy(Qt::NoFocus);
    m_list->setTextElideMode(Qt::ElideMiddle);
    m_list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_nameCaption->setText(tr("Name of the chosen fabric (Enter: the next one)"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addLayout(actionsRow({m_byFile, m_byFolder}));
    column->addWidget(m_count);
    column->addWidget(m_list);
    column->addWidget(m_nameCaption);
    column->addWidget(m_name);
    column->addWidget(m_message);
    column->addLayout(actionsRow({m_remove}));
}

fs::path PhotographList::groupOf(const Photograph& photograph) const
{
    return m_isByFolder ? photograph.file.parent_path() : photograph.file;
}

std::string PhotographList::nameOf(const Photograph& photograph) const
{
    const fs::path group = groupOf(photograph);
    const auto typed = m_names.find(group);
    if (typed != m_names.end()) return typed->second;
    return m_isByFolder ? group.filename().string() : group.stem().string();
}

bool PhotographList::contains(const fs::path& file) const
{
    return std::any_of(m_photographs.begin(), m_photographs.end(), [&](const auto& one) { return one.file == file; });
}

void PhotographList::add(const std::vector<Photograph>& photographs)
{
    fs::path first;
    for (const Photograph& photograph : photographs) {
        if (contains(photograph.file)) continue;
        if (first.empty()) first = photograph.file;
        m_photographs.push_back(photograph);
    }
    if (first.empty()) return;
    sortByFabric();
    list(first);
    Q_EMIT changed();
}

void PhotographList::sortByFabric()
{
    std::sort(m_photographs.begin(), m_photographs.end(), [this](const Photograph& a, const Photograph& b) {
        return std::pair(groupOf(a), a.file) < std::pair(groupOf(b), b.file);
    });
}

std::vector<NamedPhotograph> PhotographList::named() const
{
    std::vector<NamedPhotograph> photographs;
    for (const Photograph& one : m_photographs) photographs.push_back({one.file, nameOf(one)});
    return photographs;
}

int PhotographList::fabricCount() const
{
    std::set<fs::path> groups;
    for (const Photograph& one : m_photographs) groups.insert(groupOf(one));
    return static_cast<int>(groups.size());
}

const PhotographList::Photograph* PhotographList::chosen() const
{
    const int row = m_list->indexOfTopLevelItem(m_list->currentItem());
    return row < 0 || row >= static_cast<int>(m_photographs.size()) ? nullptr : &m_photographs[static_cast<std::size_t>(row)];
}

void PhotographList::list(const fs::path& chosenFile)
{
    {
        const QSignalBlocker quiet(m_list);
        m_list->clear();
        QTreeWidgetItem* chosenRow = nullptr;
        for (const Photograph& one : m_photographs) {
            auto* row = new QTreeWidgetItem(m_list, {textOf(nameOf(one)), textOf(one.file.filename().string()),
                                                     tr("%1 × %2").arg(one.sizePx.width()).arg(one.sizePx.height())});
            row->setToolTip(fileColumn, textOf(one.file.string()));
            if (one.file == chosenFile || !chosenRow) chosenRow = row;
        }
        if (chosenRow) m_list->setCurrentItem(chosenRow);
    }
    const int fabrics = fabricCount(), photographs = static_cast<int>(m_photographs.size());
    m_count->setText(tr("%1 %2, %3 %4")
                         .arg(photographs)
                         .arg(photographs == 1 ? tr("photograph") : tr("photographs"))
                         .arg(fabrics)
                         .arg(fabrics == 1 ? tr("fabric") : tr("fabrics")));
    for (QWidget* part : {static_cast<QWidget*>(m_byFile), static_cast<QWidget*>(m_byFolder), static_cast<QWidget*>(m_count),
                          static_cast<QWidget*>(m_list), static_cast<QWidget*>(m_nameCaption), static_cast<QWidget*>(m_name),
                          static_cast<QWidget*>(m_remove)})
        part->setVisible(!isEmpty());
    if (isEmpty()) m_message->clearMessage();
    arrange();
    choose();
}

void PhotographList::choose()
{
    const Photograph* one = chosen();
    m_name->setText(one ? textOf(nameOf(*one)) : QString());
    if (one) showNameFault(groupOf(*one));
    Q_EMIT photographChosen();
}

QString PhotographList::faultOf(const fs::path& group) const
{
    std::string own;
    for (const Photograph& one : m_photographs)
        if (groupOf(one) == group) own = nameOf(one);
    if (own.empty()) return tr("This fabric has no name. Type a name, such as the one on its label.");
    if (const std::string fault = protocols::faultOfId(own); !fault.empty())
        return tr("The name \"%1\" %2. A name has %3.")
            .arg(textOf(own), inOwnLanguage(fault), inOwnLanguage(protocols::idRule()));
    for (const Photograph& other : m_photographs)
        if (groupOf(other) != group && nameOf(other) == own)
            return tr("Two fabrics have the name \"%1\". Give one of them another name.").arg(textOf(own));
    return {};
}

void PhotographList::showNameFault(const fs::path& group)
{
    const QString fault = faultOf(group);
    if (fault.isEmpty())
        m_message->clearMessage();
    else
        m_message->showFault(fault);
}

void PhotographList::rename(const QString& typed)
{
    const Photograph* one = chosen();
    if (!one) return;
    const fs::path group = groupOf(*one);
    m_names[group] = typed.trimmed().toStdString();
    for (int row = 0; row < m_list->topLevelItemCount(); ++row)
        if (groupOf(m_photographs[static_cast<std::size_t>(row)]) == group)
            m_list->topLevelItem(row)->setText(fabricColumn, textOf(m_names[group]));
    showNameFault(group);
    Q_EMIT changed();
}

bool PhotographList::hasGoodNames()
{
    for (std::size_t row = 0; row < m_photographs.size(); ++row) {
        const QString fault = faultOf(groupOf(m_photographs[row]));
        if (fault.isEmpty()) continue;
        m_list->setCurrentItem(m_list->topLevelItem(static_cast<int>(row)));
        m_name->setFocus();
        m_name->selectAll();
        m_message->showFault(fault);
        return false;
    }
    return true;
}

void PhotographList::nextFabric()
{
    const Photograph* one = chosen();
    for (int row = m_list->indexOfTopLevelItem(m_list->currentItem()); one && row < m_list->topLevelItemCount(); ++row) {
        if (groupOf(m_photographs[static_cast<std::size_t>(row)]) == groupOf(*one)) continue;
        m_list->setCurrentItem(m_list->topLevelItem(row));
        m_name->selectAll();
        return;
    }
    m_remove->setFocus();  // the last fabric has its name
}

void PhotographList::removeChosen()
{
    const Photograph* one = chosen();
    if (!one) return;
    const auto at = m_photographs.begin() + (one - m_photographs.data());
    const auto next = m_photographs.erase(at);
    list(next != m_photographs.end() ? next->file : m_photographs.empty() ? fs::path() : m_photographs.back().file);
    Q_EMIT changed();
}

void PhotographList::group(bool byFolder)
{
    m_isByFolder = byFolder;
    m_byFile->setChecked(!byFolder);
    m_byFolder->setChecked(byFolder);
    const fs::path file = chosen() ? chosen()->file : fs::path();
    sortByFabric();
    list(file);
    Q_EMIT changed();
}

void PhotographList::showWarnings(const std::vector<QStringList>& warnings)
{
    for (int row = 0; row < m_list->topLevelItemCount(); ++row) {
        const bool isKnown = static_cast<std::size_t>(row) < warnings.size();
        const auto count = isKnown ? warnings[static_cast<std::size_t>(row)].size() : 0;
        m_list->topLevelItem(row)->setText(checkColumn, !isKnown     ? QString()
                                                        : count == 0 ? tr("no warning")
                                                        : count == 1 ? tr("1 warning")
                                                                     : tr("%1 warnings").arg(count));
    }
}

void PhotographList::focusFirst() { m_list->setFocus(); }

void PhotographList::arrange()
{
    const int rows = std::clamp(m_list->topLevelItemCount() + 1, 3, 8);
    m_list->setFixedHeight(m_list->fontMetrics().height() * 2 * rows);
}

void PhotographList::changeEvent(QEvent* event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange)
        QMetaObject::invokeMethod(this, &PhotographList::arrange, Qt::QueuedConnection);
}

void PhotographList::keyPressEvent(QKeyEvent* event)
{
    const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (event->key() == Qt::Key_Delete && m_list->hasFocus())
        removeChosen();
    else if (isEnter && m_list->hasFocus())
        m_name->setFocus(Qt::TabFocusReason);
    else if (isEnter && m_name->hasFocus())
        nextFabric();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
