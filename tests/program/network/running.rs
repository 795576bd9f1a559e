//! A monitor that runs, beside its listener.

use super::super::recordings::{lines, recorded};
use assert_cmd::cargo::cargo_bin;
use std::io::{BufRead, BufReader, Write};
use std::net::SocketAddr;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use tempfile::TempDir;

/// A folder with a ride, of which a monitor reports every change.
pub struct Bench {
    pub folder: TempDir,
    /// The samples of the ride.
    pub ride: String,
}

/// A monitor that runs.
pub struct Running {
    pub child: Child,
    stdin: Option<ChildStdin>,
    /// The lines that it prints.
    printed: Arc<Mutex<Vec<String>>>,
    threads: [JoinHandle<()>; 2],
    /// What it says on standard error.
    said: Arc<Mutex<String>>,
}

impl Bench {
    pub fn new() -> Self {
        let folder = recorded(&[]);
        let ride = lines(folder.path(), ",");
        let ride = ride
            .lines()
            .map(|line| format!("{}\n", line.split_once(',').unwrap().1))
            .collect();
        Self { folder, ride }
    }

    pub fn command(address: &str) -> String {
        let program = cargo_bin("liftsim").display().to_string();
        format!(
            "exec {program} monitor --rate 100 --begins rest --tcp {address} --spool lift.spool --spool-size 256 \
             --tcp-wait 120"
        )
    }

    /// Starts a monitor that tries again quickly.
    pub fn start(&self, address: SocketAddr) -> Running {
        self.run(&Self::command(&address.to_string()))
    }

    pub fn run(&self, command: &str) -> Running {
        let mut child = Command::new("sh")
            .args(["-c", command])
            .current_dir(&self.folder)
            .env("LIFTSIM_RETRY_AFTER", "0.001")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (printed, said) = (
            Arc::new(Mutex::new(Vec::new())),
            Arc::new(Mutex::new(String::new())),
        );
        let (out, err) = (child.stdout.take().unwrap(), child.stderr.take().unwrap());
        let (lines, text) = (printed.clone(), said.clone());
        let threads = [
            thread::spawn(move || {
                for line in BufReader::new(out).lines() {
                    lines.lock().unwrap().push(line.unwrap());
                }
            }),
            thread::spawn(move || {
                for line in BufReader::new(err).lines() {
                    *text.lock().unwrap() += &(line.unwrap() + "\n");
                }
            }),
        ];
        let stdin = child.stdin.take();
        Running {
            child,
            stdin,
            printed,
            threads,
            said,
        }
    }
}

impl Running {
    pub fn feed(&mut self, text: &str) {
        self.stdin
            .as_mut()
            .unwrap()
            .write_all(text.as_bytes())
            .unwrap();
    }

    pub fn printed(&self) -> usize {
        self.printed.lock().unwrap().len()
    }

    pub fn says(&self, text: &str) -> bool {
        self.said.lock().unwrap().contains(text)
    }

    /// Waits for its end. Returns its exit code, what it printed, and what it said.
    pub fn end(mut self) -> (Option<i32>, Vec<String>, String) {
        drop(self.stdin.take());
        let code = self.child.wait().unwrap().code();
        for thread in self.threads {
            thread.join().unwrap();
        }
        let printed = self.printed.lock().unwrap().clone();
        let said = self.said.lock().unwrap().clone();
        (code, printed, said)
    }
}
