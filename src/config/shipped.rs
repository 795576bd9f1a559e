//! The configs that the program carries, for use where there is no checkout.

/// A config of `configs/`.
#[derive(Clone, Copy, Debug)]
pub struct Shipped {
    /// The name of its file without `.toml`.
    pub name: &'static str,
    /// The command that it is for.
    pub command: &'static str,
    /// The text of its file.
    pub text: &'static str,
}

/// All of them, by name.
pub const SHIPPED: &[Shipped] = include!(concat!(env!("OUT_DIR"), "/shipped.rs"));

impl Shipped {
    /// The one of this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        SHIPPED.iter().find(|shipped| shipped.name == name)
    }
}
