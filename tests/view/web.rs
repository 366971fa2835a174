//! A browser that knows no more than requests and answers.

use serde_json::Value;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

/// After this a test that waits for another thread or process is taken for dead, not for slow.
pub const PATIENCE: Duration = Duration::from_secs(60);

pub struct Web {
    /// `127.0.0.1:4000`.
    pub host: String,
}

pub struct Answer {
    pub status: u16,
    pub headers: String,
    pub body: Vec<u8>,
}

impl Answer {
    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub fn json(&self) -> Value {
        assert_eq!(self.status, 200, "{}", self.text());
        serde_json::from_slice(&self.body).expect("is JSON")
    }
}

impl Web {
    pub fn new(url: &str) -> Web {
        let host = url.trim_start_matches("http://").trim_end_matches('/');
        Web {
            host: host.to_owned(),
        }
    }

    /// Sends a request as it is written, and reads the answer to its end.
    pub fn raw(&self, request: &str) -> Answer {
        let mut stream = TcpStream::connect(&self.host).expect("is there");
        stream
            .set_read_timeout(Some(PATIENCE))
            .expect("has a clock");
        stream.write_all(request.as_bytes()).expect("listens");
        let mut all = vec![];
        stream.read_to_end(&mut all).expect("answers");
        let end = all
            .windows(4)
            .position(|w| w == b"\r\n\r\n")
            .expect("has headers");
        let headers = String::from_utf8_lossy(&all[..end]).into_owned();
        let status = headers.split(' ').nth(1).and_then(|s| s.parse().ok());
        Answer {
            status: status.expect("has a status"),
            body: all[end + 4..].to_vec(),
            headers,
        }
    }

    pub fn get(&self, path: &str) -> Answer {
        let host = &self.host;
        self.raw(&format!(
            "GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"
        ))
    }

    pub fn post(&self, path: &str, body: &Value) -> Answer {
        let (host, body) = (&self.host, body.to_string());
        let length = body.len();
        self.raw(&format!(
            "POST {path} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Type: application/json\r\n\
             Content-Length: {length}\r\nConnection: close\r\n\r\n{body}"
        ))
    }

    /// What a file makes now.
    pub fn state(&self, file: &str) -> Value {
        self.get(&format!("/api/state?file={file}")).json()
    }

    /// Hears what is said of a file: names of events and what they carry.
    pub fn listen(&self, file: &str) -> Ear {
        let host = &self.host;
        let mut stream = TcpStream::connect(host).expect("is there");
        write!(
            stream,
            "GET /api/events?file={file} HTTP/1.1\r\nHost: {host}\r\n\r\n"
        )
        .expect("listens");
        let (sender, heard) = mpsc::channel();
        let reader = BufReader::new(stream.try_clone().expect("can be shared"));
        std::thread::spawn(move || {
            let mut name = String::new();
            for line in reader.lines() {
                let Ok(line) = line else { return };
                if let Some(event) = line.strip_prefix("event: ") {
                    name = event.to_owned();
                } else if let Some(data) = line.strip_prefix("data: ") {
                    let data = serde_json::from_str(data).expect("is JSON");
                    if sender.send((name.clone(), data)).is_err() {
                        return;
                    }
                }
            }
        });
        Ear { heard, stream }
    }
}

/// Somebody who listens.
pub struct Ear {
    heard: Receiver<(String, Value)>,
    stream: TcpStream,
}

impl Ear {
    /// The next thing that is said.
    pub fn hear(&self) -> (String, Value) {
        self.heard
            .recv_timeout(PATIENCE)
            .expect("something is said")
    }

    /// Whether nothing is said for a while.
    pub fn silent(&self) -> bool {
        self.heard.recv_timeout(Duration::from_millis(300)).is_err()
    }
}

impl Drop for Ear {
    fn drop(&mut self) {
        let _ = self.stream.shutdown(std::net::Shutdown::Both);
    }
}
