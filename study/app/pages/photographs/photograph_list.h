// The photographs of a new data set: a list, the rule that sorts them into fabrics, and the names of the fabrics.
#pragma once

#include <QSize>
#include <QStringList>
#include <QWidget>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/app/state/photograph_steps.h"

class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;

namespace study::app {

class MessageBar;

class PhotographList : public QWidget {
    Q_OBJECT
public:
    explicit PhotographList(QWidget* parent);

    struct Photograph {
        std::filesystem::path file;
        QSize sizePx;
    };
    /// Adds photographs that are not in the list yet, and chooses the first of them.
    void add(const std::vector<Photograph>& photographs);
    bool isEmpty() const { return m_photographs.empty(); }
    bool contains(const std::filesystem::path& file) const;
    /// The photographs in the order of the list, with the names of their fabrics.
    std::vector<NamedPhotograph> named() const;
    /// Number of fabrics.
    int fabricCount() const;
    /// The chosen photograph; nullptr while the list is empty.
    const Photograph* chosen() const;
    /// Shows the result of the check beside each photograph, in the order of named().
    void showWarnings(const std::vector<QStringList>& warnings);
    /// Shows the first fault of the names beside the name and moves the focus there. True if there is none.
    bool hasGoodNames();
    void focusFirst();

Q_SIGNALS:
    /// Photographs, or names of fabrics, were changed.
    void changed();
    void photographChosen();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void build();
    void sortByFabric();
    void list(const std::filesystem::path& chosenFile);
    void choose();
    void rename(const QString& name);
    void nextFabric();
    void removeChosen();
    void group(bool byFolder);
    void arrange();
    std::filesystem::path groupOf(const Photograph& photograph) const;
    std::string nameOf(const Photograph& photograph) const;
    /// The fault of the name of this group, as a sentence; empty if there is none.
    QString faultOf(const std::filesystem::path& group) const;
    void showNameFault(const std::filesystem::path& group);

    std::vector<Photograph> m_photographs;
    bool m_isByFolder = false;
    std::map<std::filesystem::path, std::string> m_names;  ///< names that were typed, by file or folder of the fabric
    QPushButton* m_byFile;
    QPushButton* m_byFolder;
    QTreeWidget* m_list;
    QLabel* m_count;
    QLabel* m_nameCaption;
    QLineEdit* m_name;
    QPushButton* m_remove;
    MessageBar* m_message;
};

}  // namespace study::app
