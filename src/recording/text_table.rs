//! A table of text as it is made of a workbook or of JSON.

/// The largest, bytes: a few bytes of what it is made of may stand for any number.
pub(super) const LARGEST: usize = 1 << 30;

/// The most columns, and letters in a cell.
pub(super) const MOST_COLUMNS: usize = 64;
pub(super) const MOST_LETTERS: usize = 200;

/// Lines of cells separated by tabs.
#[derive(Debug, Default)]
pub(super) struct TextTable {
    text: Vec<u8>,
    /// Lines before this one, and cells in it.
    row: usize,
    column: usize,
}

impl TextTable {
    /// Begins the row of this number, from 1. Those before it that were not written are blank.
    ///
    /// # Errors
    /// If rows are not in order, or too many.
    pub fn begin_row(&mut self, number: usize) -> Result<(), String> {
        let blank = number.checked_sub(self.row + 1);
        let blank =
            blank.ok_or_else(|| format!("row {number} must stand after row {}", self.row))?;
        if self.text.len().saturating_add(blank) > LARGEST {
            return Err(too_large());
        }
        self.text.resize(self.text.len() + blank, b'\n');
        self.row += blank;
        self.column = 0;
        Ok(())
    }

    /// Writes a cell in this column, from 0, without what would end it.
    ///
    /// # Errors
    /// If cells are not in order.
    pub fn cell(&mut self, column: usize, words: &str) -> Result<(), String> {
        if column < self.column {
            return Err(format!(
                "the cells of row {} must stand in order",
                self.row + 1
            ));
        }
        self.fill(column + 1);
        let plain = |c: char| if c.is_control() || c == '"' { ' ' } else { c };
        let words: String = words.chars().take(MOST_LETTERS).map(plain).collect();
        self.text.extend(words.as_bytes());
        Ok(())
    }

    /// Ends the row, which is filled up to so many cells unless it is blank.
    pub fn end_row(&mut self, width: usize) {
        if self.column > 0 {
            self.fill(width);
        }
        self.text.push(b'\n');
        self.row += 1;
    }

    /// A last row that was cut off within its first cell.
    ///
    /// # Errors
    /// As for any row.
    pub fn cut_off(&mut self, number: usize) -> Result<(), String> {
        self.begin_row(number)?;
        self.cell(0, "{")
    }

    fn fill(&mut self, width: usize) {
        let tabs = width.saturating_sub(self.column.max(1));
        self.text.resize(self.text.len() + tabs, b'\t');
        self.column = self.column.max(width);
    }

    /// The number of the next row, from 1, and of the next column, from 0.
    pub fn next(&self) -> (usize, usize) {
        (self.row + 1, self.column)
    }

    /// Bytes.
    pub fn size(&self) -> usize {
        self.text.len()
    }

    pub fn into_text(self) -> Vec<u8> {
        self.text
    }
}

pub(super) fn too_large() -> String {
    "must be at most 1 GB large, as a table too".to_owned()
}
