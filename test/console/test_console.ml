open Lwt.Infix
open Dolphin_console
module Server = Dolphin_http.Server
module Request = Dolphin_http.Request

(* {1 A console of a folder} *)

let mission = "input 'go'\nmessage 'begins'\nx = ask 'How many?'\nmessage x\nexecute condition { consume go: _ }\n"
let short = "message 'one'\npause 2.seconds\nmessage 'two'\n"

let write path text =
  let channel = open_out_bin path in
  output_string channel text;
  close_out channel

let rec remove path =
  match (Unix.lstat path).st_kind with
  | S_DIR -> Array.iter (fun name -> remove (Filename.concat path name)) (Sys.readdir path); Unix.rmdir path
  | _ -> Unix.unlink path

let in_folder f =
  let home = Filename.temp_file "console" "" in
  Unix.unlink home;
  let folder = Filename.concat home "missions" in
  List.iter (fun path -> Unix.mkdir path 0o755) [ home; folder; Filename.concat folder "sub" ];
  Unix.putenv "XDG_STATE_HOME" (Filename.concat home "state");
  write (Filename.concat folder "mission.dol") mission;
  write (Filename.concat folder "short.dol") short;
  write (Filename.concat folder "wrong.dol") "message askk\n";
  write (Filename.concat folder "sub/other.fleet") "vehicle 'a', { type 'UUV' }\n";
  write (Filename.concat folder "notes.txt") "private\n";
  write (Filename.concat folder ".hidden.dol") "say 'private'\n";
  write (Filename.concat home "outside.dol") "say 'private'\n";
  Unix.symlink "../outside.dol" (Filename.concat folder "link.dol");
  Unix.symlink ".." (Filename.concat folder "up");
  Fun.protect ~finally:(fun () -> remove home) (fun () -> f folder)

let settings folder : Console.settings =
  { folder = Result.get_ok (Folder.make folder); run = Dolphin_app.Run.simulated; fleet = None;
    dolphin = Sys.executable_name; page = Page.load None; tiles = None; listen = None; certificate = None;
    operators = Operators.anonymous (); proxy_header = None; version = "test";
    workers = Worker_pool.limits }

let served settings f () =
  in_folder (fun folder ->
      let console = Result.get_ok (Console.start (settings folder) ~port:0) in
      let whole () = Lwt_unix.with_timeout 300. (fun () -> f folder console) in
      Lwt_main.run (Lwt.finalize whole (fun () -> Console.close console)))

let console f = served settings (fun folder console -> f folder (Console.port console))

let status = Alcotest.(check int)
let text = Alcotest.(check string)
let holds = Alcotest.(check bool)

let member path json =
  let one json name = match json with `Assoc _ -> Yojson.Safe.Util.member name json | _ -> `Null in
  List.fold_left one json path

let has_text part text =
  match Str.search_forward (Str.regexp_string part) text 0 with _ -> true | exception Not_found -> false

let code reply = Yojson.Safe.Util.to_string (member [ "error"; "code" ] (Client.json reply))

let refused what expected reply =
  status what (fst expected) reply.Client.status;
  text what (snd expected) (code reply)

(* {1 Requests} *)

let heads () =
  let fault text =
    match Request.of_head text with
    | Ok (_, length) -> Printf.sprintf "%d" length
    | Error (Malformed _) -> "malformed"
    | Error Too_large -> "too large"
    | Error (Unsupported _) -> "unsupported"
  in
  let check expected head = text (String.escaped head) expected (fault head) in
  check "0" "GET / HTTP/1.1\r\nHost: a";
  check "3" "POST /x HTTP/1.1\r\nContent-Length: 3";
  check "malformed" "";
  check "malformed" "GET";
  check "malformed" "GET x HTTP/1.1";
  check "malformed" "GET /%zz HTTP/1.1";
  check "malformed" "GET /% HTTP/1.1";
  check "malformed" "GET / HTTP/1.1\r\nno header";
  check "malformed" "GET / HTTP/1.1\r\nHo st: a";
  check "malformed" "GET / HTTP/1.1\r\nHost: a\001";
  check "malformed" "POST / HTTP/1.1\r\nContent-Length: -1";
  check "malformed" "POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2";
  check "too large" "POST / HTTP/1.1\r\nContent-Length: 99999999999999999999";
  check "unsupported" "POST / HTTP/1.1\r\nTransfer-Encoding: chunked";
  check "unsupported" "GET / HTTP/2";
  let path target =
    match Request.of_head ("GET " ^ target ^ " HTTP/1.1") with
    | Ok (r, _) -> String.concat "|" (r.path @ List.map (fun (name, x) -> name ^ "=" ^ x) r.query)
    | Error _ -> "none"
  in
  text "decoded" "a|../b|c=d e" (path "/a//..%2fb?c=d+e");
  text "no target" "none" (path "a")

let who_may_ask _ port =
  let ask ?verb ?body headers = Client.ask ?verb ?body ~headers ~port "/api/status" in
  ask [] >>= fun r ->
  status "as it is" 200 r.status;
  let localhost = Printf.sprintf "localhost:%d" port in
  ask [ ("Host", localhost); ("Origin", "http://" ^ localhost) ] >>= fun r ->
  status "its own page" 200 r.status;
  Lwt_list.iter_s
    (fun (what, expected, headers) -> ask headers >|= refused what (expected, "refused"))
    [ ("another name", 421, [ ("Host", "evil.example") ]);
      ("its port, as nobody writes it", 421, [ ("Host", Printf.sprintf "localhost:0x%x" port) ]);
      ("the same in another way", 421, [ ("Host", Printf.sprintf "localhost:%d_%d" (port / 10) (port mod 10)) ]);
      ("another port", 421, [ ("Host", "127.0.0.1:1") ]);
      ("a foreign page", 403, [ ("Origin", "http://evil.example") ]);
      ("a page of no origin", 403, [ ("Origin", "null") ]);
      ("a foreign page by another header", 403, [ ("Sec-Fetch-Site", "cross-site") ]) ]
  >>= fun () ->
  Client.ask ~headers:[ ("Content-Type", "text/plain") ] ~body:"{}" ~port "/api/run/stop" >>= fun r ->
  refused "as a form sends it" (415, "refused") r;
  Client.raw ~no_more:true ~port "GET /api/status HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n" >|= fun reply ->
  holds "two hosts" true (String.length reply > 12 && String.sub reply 9 3 = "400")

let begins expected reply =
  let start = if String.length reply < 12 then reply else String.sub reply 9 3 in
  text "status" expected start

(* For other machines there are two links, each with a token. *)
let with_tokens _ console =
  let port = Console.port console in
  let token role = List.nth (String.split_on_char '=' (List.assoc role (Console.links console))) 1 in
  let steers = ("Authorization", "Bearer " ^ token "steers") and watches = ("Authorization", "Bearer " ^ token "watches") in
  let ask ?body headers path = Client.ask ?body ~headers ~port path in
  ask [] "/api/status" >>= fun r ->
  refused "without a token" (401, "refused") r;
  ask [ ("Authorization", "Bearer " ^ String.make 32 '0') ] "/api/status" >>= fun r ->
  refused "with another one" (401, "refused") r;
  ask [] "/" >>= fun r ->
  status "the page alone" 200 r.status;
  let enter text = Client.raw ~no_more:true ~port (Printf.sprintf "GET /?token=%s HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n\r\n" text port) in
  enter "wrong" >>= fun reply ->
  begins "200" reply;
  enter (token "watches") >>= fun reply ->
  begins "303" reply;
  let cookie = Printf.sprintf "dolphin-%d=%s" port (token "watches") in
  let kept = Str.regexp_string (Printf.sprintf "Set-Cookie: %s; Path=/; HttpOnly; SameSite=Strict" cookie) in
  holds "a cookie" true (match Str.search_forward kept reply 0 with _ -> true | exception Not_found -> false);
  let cookie = ("Cookie", "other=1; " ^ cookie) in
  Lwt_list.iter_s
    (fun (what, who, code) -> ask ~body:{|{"program": "short.dol"}|} [ who ] "/api/run" >|= fun r -> status what code r.status)
    [ ("by the cookie one watches", cookie, 403); ("and by the token", watches, 403) ]
  >>= fun () ->
  ask ~body:{|{"want": "take"}|} [ watches ] "/api/helm" >>= fun r ->
  refused "the helm" (403, "watches") r;
  ask ~body:{|{"path": "short.dol"}|} [ watches ] "/api/check" >>= fun r ->
  status "who watches may look" 200 r.status;
  let host name = ("Host", Printf.sprintf "%s:%d" name port) in
  ask [ steers; host "192.0.2.7" ] "/api/status" >>= fun r ->
  status "by any address" 200 r.status;
  ask [ steers; host "evil.example" ] "/api/status" >>= fun r ->
  refused "by no other name" (421, "refused") r;
  ask [ steers; host "192.0.2.7"; ("Origin", "http://192.0.2.8") ] "/api/status" >>= fun r ->
  refused "from no other page" (403, "refused") r;
  ask ~body:{|{"program": "short.dol"}|} [ steers ] "/api/run" >|= fun r -> status "who steers" 200 r.status

(* {1 The page} *)

let gunzip text =
  let path = Filename.temp_file "console" ".gz" in
  write path text;
  let channel = Unix.open_process_args_in "gzip" [| "gzip"; "-dc"; path |] in
  let buffer = Buffer.create 4096 in
  (try while true do Buffer.add_channel buffer channel 1 done with End_of_file -> ());
  let found = Buffer.contents buffer in
  let status = Unix.close_process_in channel in
  Unix.unlink path;
  if status = WEXITED 0 then found else Alcotest.fail "gzip cannot read it"

let script = String.concat "" (List.init 20_000 (fun i -> Printf.sprintf "const x%d = %d;\n" i (i * i)))

let page_of folder =
  let page = Filename.concat folder "../page" in
  Unix.mkdir page 0o755;
  write (Filename.concat page "index.html") "<!doctype html>";
  write (Filename.concat page "main.js") script;
  write (Filename.concat page "empty.js") "";
  Page.load (Some page)

(* Compressed for browsers that read it; sent once, as long as it has not changed. *)
let page_is_cached _ console =
  let port = Console.port console in
  let get ?(headers = []) path =
    let lines = List.map (fun (name, x) -> name ^ ": " ^ x ^ "\r\n") headers in
    let request = Printf.sprintf "GET /%s HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nConnection: close\r\n%s\r\n" path port
        (String.concat "" lines) in
    Client.raw ~port request >|= fun reply ->
    match Str.bounded_split_delim (Str.regexp_string "\r\n\r\n") reply 2 with
    | [ head; body ] -> (String.split_on_char '\n' (String.concat "" (String.split_on_char '\r' head)), body)
    | _ -> Alcotest.fail "no reply"
  in
  let header name head =
    let before = name ^ ": " in
    let n = String.length before in
    let value line =
      let length = String.length line in
      if length > n && String.sub line 0 n = before then Some (String.sub line n (length - n)) else None in
    match List.filter_map value head with [ value ] -> value | [] -> "" | _ -> Alcotest.failf "%s twice" name
  in
  get "main.js" >>= fun (head, body) ->
  text "as it is" script body;
  text "not compressed" "" (header "Content-Encoding" head);
  text "asked for again" "no-cache" (header "Cache-Control" head);
  let plain = header "ETag" head in
  let gzip = ("Accept-Encoding", "deflate, gzip;q=0.8, br") in
  get ~headers:[ gzip ] "main.js" >>= fun (head, body) ->
  text "compressed" "gzip" (header "Content-Encoding" head);
  holds "shorter" true (String.length body < String.length script / 2);
  text "the same" script (gunzip body);
  let tag = header "ETag" head in
  holds "another tag" true (tag <> plain);
  Lwt_list.iter_s
    (fun (what, expected, headers) ->
       get ~headers "main.js" >|= fun (head, body) ->
       text what ("HTTP/1.1 " ^ expected) (List.hd head);
       if expected = "304 Not Modified" then begin
         text "no body" "" body;
         text "no length" "" (header "Content-Length" head);
         text "its tag" tag (header "ETag" head)
       end)
    [ ("the browser has it", "304 Not Modified", [ gzip; ("If-None-Match", tag) ]);
      ("among others", "304 Not Modified", [ gzip; ("If-None-Match", "\"x\", W/" ^ tag) ]);
      ("whatever it has", "304 Not Modified", [ gzip; ("If-None-Match", "*") ]);
      ("in the other encoding", "200 OK", [ gzip; ("If-None-Match", plain) ]);
      ("another one", "200 OK", [ ("If-None-Match", "\"x\"") ]) ]
  >>= fun () ->
  get ~headers:[ ("Accept-Encoding", "gzip;q=0, identity") ] "main.js" >>= fun (head, _) ->
  text "refused by the browser" "" (header "Content-Encoding" head);
  get ~headers:[ gzip ] "empty.js" >>= fun (head, body) ->
  text "a short one" "" (header "Content-Encoding" head ^ body);
  get "api/status" >|= fun (head, _) -> text "the interface is not kept" "no-store" (header "Cache-Control" head)

(* {1 Files} *)

let no_escape folder port =
  let paths =
    [ "../outside.dol"; "..%2foutside.dol"; "sub/../../outside.dol"; "link.dol"; "up/outside.dol"; ".hidden.dol";
      "notes.txt"; "%2fetc%2fpasswd"; "mission.dol%00.fleet"; "sub"; ""; "up/missions/.hidden.dol"; "./mission.dol" ]
  in
  Lwt_list.iter_s
    (fun path ->
       Client.ask ~port ("/api/file?path=" ^ path) >>= fun r ->
       refused path (404, "not-found") r;
       let decoded code text = Str.global_replace (Str.regexp_string code) text in
       let plain = decoded "%00" {|\\u0000|} (decoded "%2f" "/" path) in
       let body = Printf.sprintf {|{"path": "%s", "text": "x"}|} plain in
       Client.ask ~verb:"PUT" ~body ~port "/api/file" >|= fun r ->
       holds ("not saved: " ^ path) true (r.status >= 400))
    paths
  >>= fun () ->
  text "outside as it was" "say 'private'\n"
    (Result.get_ok (Dolphin_app.Text_file.read (Filename.concat folder "../outside.dol")));
  Client.ask ~port "/api/files" >>= fun r ->
  text "what is listed"
    ({|{"programs":["mission.dol","short.dol","wrong.dol"],|} ^ {|"fleets":["sub/other.fleet"],"journals":[],"layers":[]}|})
    (String.trim r.body);
  Client.ask ~port "/../../etc/passwd" >>= fun r ->
  status "no page" 404 r.status;
  (* Nor by what a text names, or a link beside it. *)
  let told what path body =
    Client.ask ~body ~port ("/api/" ^ path) >|= fun r ->
    let has part = try ignore (Str.search_forward (Str.regexp_string part) r.body 0); true with Not_found -> false in
    holds (what ^ ": what is there is not told: " ^ r.body) false (has "private" || has "secret");
    r.body
  in
  let program text = write (Filename.concat folder "names.dol") text in
  let outside = Filename.concat folder "../outside.dol" in
  write outside "def secret(x) { private }\n";
  program "include '../outside.dol'\nmessage secret(1)\n";
  told "run" "run" {|{"program": "names.dol"}|} >>= fun there ->
  Unix.unlink outside;
  told "run" "run" {|{"program": "names.dol"}|} >>= fun gone ->
  text "nor whether it is there" gone there;
  write outside "def secret(x) { private }\n";
  program "include 'up/../../outside.dol'\nx = map '../outside.dol'\n";
  told "by a link" "run" {|{"program": "names.dol"}|} >>= fun _ ->
  let typed = {|{"path": "names.dol", "text": "include '../outside.dol'\nsecret(", "at": 32}|} in
  told "typed" "signature" typed >>= fun found ->
  text "nothing is known of it" "null\n" found;
  told "typed" "check" typed >>= fun _ ->
  write (Filename.concat folder "../outside.fleet") "vehicle 'secret', { type 'UUV' }\n";
  Unix.symlink "../outside.fleet" (Filename.concat folder "names.fleet");
  program "message 'x'\n";
  Client.ask ~port "/api/world?program=names.dol" >>= fun r ->
  status "the program is read" 200 r.status;
  holds "but not the fleet that a link leads to" true (member [ "fleet" ] (Client.json r) = `Null);
  (* Nor hidden files, those of other kinds, hard links, pipes; the answer does not depend on what is there. *)
  List.iter (fun name -> write (Filename.concat folder name) "secret_of_mine\n") [ ".env"; "_env.dol"; "notes.txt"; ".x.dol" ];
  Unix.link outside (Filename.concat folder "hard.dol");
  Unix.mkfifo (Filename.concat folder "pipe.dol") 0o600;
  write (Filename.concat folder "-rf.dol") "message 'x'\n";
  write (Filename.concat folder "two\nlines.dol") "message 'x'\n";
  Lwt_list.iter_s
    (fun name ->
       let typed = Printf.sprintf {|{"path": "names.dol", "text": "include '%s'\nx = map '%s'\n"}|} name name in
       Client.ask ~body:typed ~port "/api/check" >|= fun r ->
       status name 200 r.status;
       holds (name ^ ": " ^ r.body) true (has_text "no such file" r.body && not (has_text "secret" r.body)))
    [ ".env"; "_env.dol"; "notes.txt"; ".x.dol"; "hard.dol"; "pipe.dol"; "none.dol" ]
  >>= fun () ->
  Lwt_list.iter_s
    (fun path -> Client.ask ~port ("/api/file?path=" ^ path) >|= refused path (404, "not-found"))
    [ "hard.dol"; "pipe.dol"; "-rf.dol"; "two%0Alines.dol" ]
  >>= fun () ->
  Client.ask ~verb:"PUT" ~body:{|{"path": "-rf.dol", "text": ""}|} ~port "/api/file" >>= fun r ->
  refused "no option is saved" (404, "not-found") r;
  Client.ask ~port "/api/files" >|= fun r ->
  List.iter (fun name -> holds name false (has_text name r.body)) [ "hard"; "pipe"; "-rf"; "lines"; "env" ]

let saving folder port =
  let put body = Client.ask ~verb:"PUT" ~body ~port "/api/file" in
  Client.ask ~port "/api/file?path=short.dol" >>= fun r ->
  let hash = Yojson.Safe.Util.to_string (member [ "hash" ] (Client.json r)) in
  let save = Printf.sprintf {|{"path": "short.dol", "text": "say 'new'\n", "hash": "%s"}|} hash in
  put save >>= fun r ->
  status "saved" 200 r.status;
  text "the file" "say 'new'\n" (Result.get_ok (Dolphin_app.Text_file.read (Filename.concat folder "short.dol")));
  put save >>= fun r ->
  refused "it has changed since" (409, "changed") r;
  put {|{"path": "fresh.dol", "text": "say 1\n", "hash": null}|} >>= fun r ->
  status "a new one" 200 r.status;
  put {|{"path": "none/fresh.dol", "text": "say 1\n"}|} >|= refused "no such folder" (404, "not-found")

let texts _ port =
  let check body = Client.ask ~body ~port "/api/check" in
  check {|{"path": "short.dol", "text": "x = 'é'; message askk\n"}|} >>= fun r ->
  text "a fault, in places as browsers count them"
    ({|{"diagnostics":[{"from":17,"to":21,"line":1,"column":18,"severity":"error",|}
     ^ {|"message":"unknown name 'askk'","code":"unknown-name","hint":"did you mean 'ask'?"}]}|})
    (String.trim r.body);
  check (Printf.sprintf {|{"path": "short.dol", "text": "%s"}|} (String.make 300_000 'a')) >>= fun r ->
  refused "a long text" (413, "too-large") r;
  Client.ask ~body:{|{"path": "short.dol", "text": "exec", "at": 4}|} ~port "/api/complete" >>= fun r ->
  holds "completed" true
    (List.exists (fun item -> member [ "label" ] item = `String "execute")
       (Yojson.Safe.Util.to_list (member [ "items" ] (Client.json r))));
  check "{" >>= fun r ->
  refused "no JSON" (400, "bad-request") r;
  check (String.make 5_000 '[') >|= refused "deep JSON" (400, "bad-request")

(* {1 Runs} *)

let is_over (m : Client.message) =
  m.event = "status" && member [ "run"; "state" ] (Yojson.Safe.from_string m.data) = `String "over"

let events name seen = List.filter (fun (m : Client.message) -> m.event = name) seen
let data seen = List.map (fun (m : Client.message) -> m.data) seen
let of_run seen = List.filter (fun (m : Client.message) -> m.id <> "") seen

let a_run _ port =
  Client.watch ~port "first" >>= fun first ->
  Client.ask ~body:{|{"program": "short.dol"}|} ~port "/api/run" >>= fun r ->
  status "started" 200 r.status;
  Client.until first is_over >>= fun seen ->
  let said = List.filter (fun line -> member [ "severity" ] (Yojson.Safe.from_string line) = `String "said")
      (data (events "log" seen)) in
  status "what it says" 2 (List.length said);
  Client.watch ~port "late" >>= fun late ->
  let last = (List.hd (List.rev (of_run seen))).id in
  Client.until late (fun m -> m.id = last) >>= fun others ->
  holds "who comes late sees the same" true (data (of_run seen) = data (of_run others));
  let third = (List.nth (of_run seen) 2).id in
  Client.watch ~last:third ~port "back" >>= fun back ->
  Client.until back (fun m -> m.id = last) >>= fun rest ->
  status "who comes back sees the rest" (List.length (of_run seen) - 3) (List.length (of_run rest));
  Client.ask ~port "/api/runs" >>= fun r ->
  let run = List.hd (Yojson.Safe.Util.to_list (member [ "runs" ] (Client.json r))) in
  text "it is kept" {|"completed"|} (Yojson.Safe.to_string (member [ "state" ] run));
  let name = Yojson.Safe.Util.to_string (member [ "run" ] run) in
  Client.ask ~port ("/api/replay?run=" ^ name) >>= fun r ->
  let lines = List.filter (fun line -> String.length line > 6 && String.sub line 0 6 = "data: ")
      (String.split_on_char '\n' r.body) in
  let journal = data (events "journal" seen) in
  let told = List.map (fun line -> String.sub line 6 (String.length line - 6)) lines in
  holds "and told again" true (List.for_all (fun line -> List.mem line told) journal);
  Lwt_list.iter_s Client.leave [ first; late; back ]

(* Journals of the folder: with the program beside them, and without one. *)
let journals root port =
  let run = Filename.concat root "home.run" in
  Client.watch ~port "first" >>= fun first ->
  Client.ask ~body:{|{"program": "short.dol"}|} ~port "/api/run" >>= fun r ->
  status "started" 200 r.status;
  Client.until first is_over >>= fun seen ->
  Client.leave first >>= fun () ->
  let lines = data (events "journal" seen) in
  let path = Str.regexp {|"path":"[^"]*/short.dol"|} in
  let elsewhere name =
    List.map (Str.replace_first path (Printf.sprintf {|"path":"/elsewhere/%s"|} name)) lines in
  let replayed () = Client.ask ~port "/api/replay?path=home.run" in
  let told event (r : Client.reply) =
    let blocks = Str.split (Str.regexp_string "\n\n") r.body in
    List.length (List.filter (fun block -> List.mem ("event: " ^ event) (String.split_on_char '\n' block)) blocks) in
  write run (String.concat "\n" (elsewhere "short.dol") ^ "\n");
  replayed () >>= fun whole ->
  status "told" 200 whole.status;
  status "each line" (List.length lines) (told "journal" whole);
  holds "with its log: the program lies beside it" true (told "log" whole >= 2);
  write run (String.concat "\n" (elsewhere "other.dol") ^ "\n");
  replayed () >>= fun plain ->
  status "each line" (List.length lines) (told "journal" plain);
  status "but for a program that is not there: one line that says so" 1 (told "log" plain);
  (* Notes lie beside the journal, which stays as it is; a link there is not followed. *)
  let note () = Client.ask ~body:{|{"path": "home.run", "time": 1, "text": "here"}|} ~port "/api/notes" in
  let notes = Filename.concat root "home.notes" and outside = Filename.concat root "../outside.dol" in
  note () >>= fun r ->
  status "noted" 200 r.status;
  holds "in a file beside it" true (has_text {|"text":"here"|} (Result.get_ok (Dolphin_app.Text_file.read notes)));
  replayed () >>= fun again ->
  text "the journal is the same" plain.body again.body;
  Unix.unlink notes;
  Unix.symlink outside notes;
  note () >>= fun r ->
  refused "through a link" (422, "not-saved") r;
  text "nothing is written there" "say 'private'\n" (Result.get_ok (Dolphin_app.Text_file.read outside));
  write run "no journal\n";
  replayed () >|= fun r ->
  status "what is no journal" 422 r.status

let question (m : Client.message) =
  m.event = "status" && member [ "run"; "question" ] (Yojson.Safe.from_string m.data) <> `Null

(* {1 Operators} *)

let operators_file () =
  let read text =
    match Operators.read text with
    | Error why -> why
    | Ok found ->
      let one (o : Operators.operator) =
        String.concat " " (Option.get o.name :: Operators.role_word o :: o.duties) in
      String.concat ", " (List.map one found)
  in
  let check what expected found = text what expected (read found) in
  check "two" "ana steer, rui answer" "# the crew\nana steer\n\nrui\tanswer 0123456789abcdef # stays\r\n";
  check "none" "there are no operators" "# nobody yet\n";
  check "twice" "the name ana is there twice" "ana steer\nana watch\n";
  check "one token" "two operators have the same token" "a steer 0123456789abcdef\nb watch 0123456789abcdef\n";
  check "a role" "line 2: 'captain' is not a role: watch, answer, steer or admin" "a steer\nb captain\n";
  check "duties" "ana admin, rui answer pilot medic" "ana admin\nrui answer,pilot,medic\n";
  check "an empty duty" "line 1: '' is not a duty: 1 to 32 letters, digits, dashes and underscores" "rui answer,\n";
  check "a duty who watches" "line 1: an operator who watches answers no questions: no duties" "eva watch,pilot\n";
  check "a short token" "line 1: a token has 16 to 128 letters, digits, dashes and underscores" "a steer 0123\n";
  check "a name" "line 1: '<b>' is not a name: 1 to 32 letters, digits, dashes and underscores" "<b> steer\n";
  check "too much" "line 1: a line has a name, a role, and perhaps a token" "a steer 0123456789abcdef more\n";
  in_folder (fun folder ->
      let path = Filename.concat folder "crew" in
      write path "ana steer\n";
      Unix.chmod path 0o644;
      holds "others can read it" true (Result.is_error (Operators.load path));
      Unix.chmod path 0o600;
      holds "its owner alone" true (Result.is_ok (Operators.load path)))

let crew = Result.get_ok (Operators.read "ana steer\nrui answer\neva watch\n")

(* The acts of operators in the journal of the latest run, as a replay has them. *)
let acts_of_latest_run ~headers port =
  Client.ask ~headers ~port "/api/runs" >>= fun r ->
  let run =
    match member [ "runs" ] (Client.json r) with
    | `List (run :: _) -> Yojson.Safe.Util.to_string (member [ "run" ] run)
    | _ -> Alcotest.fail "no run was kept"
  in
  Client.events ~headers ~port ("/api/replay?run=" ^ run) >>= fun watcher ->
  Client.until watcher (fun m -> m.event = "end") >>= fun seen ->
  Client.leave watcher >|= fun () ->
  let act (m : Client.message) =
    match if m.event = "journal" then Dolphin_trace.Entry.of_string m.data else Error "" with
    | Ok (Act { act; _ }) -> Some (Dolphin_trace.Act.words act)
    | Ok _ | Error _ -> None
  in
  List.filter_map act seen

(* Each does what the role allows; names are seen by all. *)
let named_operators _ console =
  let port = Console.port console in
  let by name =
    let operator = List.find (fun (o : Operators.operator) -> o.name = Some name) crew in
    [ ("Authorization", "Bearer " ^ operator.token) ] in
  Alcotest.(check (list string)) "links" [ "ana, who steers"; "rui, who answers"; "eva, who watches" ]
    (List.map fst (Console.links console));
  let ask name ?body path = Client.ask ?body ~headers:(by name) ~port ("/api/" ^ path) in
  let start = {|{"program": "mission.dol", "speed": 10}|} in
  Lwt_list.iter_s
    (fun (name, code) -> ask name ~body:start "run" >|= refused name (403, code))
    [ ("rui", "answers"); ("eva", "watches") ]
  >>= fun () ->
  Client.events ~headers:(by "ana") ~port "/api/events?client=a" >>= fun ana ->
  Client.until ana (fun m -> m.event = "role") >>= fun seen ->
  holds "her name" true (has_text {|"ana-|} (List.hd (List.rev seen)).data);
  Client.ask ~headers:(("X-Dolphin-Client", "a") :: by "ana") ~body:start ~port "/api/run" >>= fun r ->
  status "she starts it" 200 r.status;
  Client.until ana question >>= fun _ ->
  ask "eva" ~body:{|{"question": 1, "text": "3"}|} "run/answer" >>= fun r ->
  refused "who watches does not answer" (403, "watches") r;
  ask "rui" ~body:{|{"question": 1, "text": "3"}|} "run/answer" >>= fun r ->
  status "he answers" 200 r.status;
  Client.until ana (fun m -> m.event = "log" && has_text "rui (answer) answers 'How many?': 3" m.data) >>= fun _ ->
  Lwt_list.iter_s
    (fun (path, body) -> ask "rui" ~body path >|= refused path (403, "answers"))
    [ ("run/stop", "{}"); ("helm", {|{"want": "force"}|}); ("exploration", {|{"program": "short.dol"}|}) ]
  >>= fun () ->
  ask "rui" ~body:{|{"pairs": "go: 1"}|} "run/post" >>= fun r ->
  status "and posts" 200 r.status;
  Client.until ana is_over >>= fun _ ->
  Client.leave ana >>= fun () -> acts_of_latest_run ~headers:(by "eva") port >|= fun acts ->
  Alcotest.(check (list string)) "the journal has who did it"
    [ "ana (steer) starts the run"; "rui (answer) answers 'How many?': 3"; "rui (answer) posts go:1" ] acts

(* Another program for the run: of the client that has the helm alone, and the journal has whose it was. *)
let replaced folder console =
  let port = Console.port console in
  let by name =
    let operator = List.find (fun (o : Operators.operator) -> o.name = Some name) crew in
    [ ("Authorization", "Bearer " ^ operator.token); ("X-Dolphin-Client", name) ] in
  let ask name ?body path = Client.ask ?body ~headers:(by name) ~port ("/api/" ^ path) in
  let program text = write (Filename.concat folder "changed.dol") text; Digest.to_hex (Digest.string text) in
  let replace name ?(path = "changed.dol") hash =
    ask name ~body:(Printf.sprintf {|{"program": %S, "hash": %S}|} path hash) "run/replace" in
  let hash = program (mission ^ "message 'more'\n") in
  replace "ana" hash >>= fun r ->
  refused "without a run" (409, "no-run") r;
  Client.events ~headers:(by "ana") ~port "/api/events?client=ana" >>= fun ana ->
  ask "ana" ~body:{|{"program": "mission.dol", "speed": 10}|} "run" >>= fun _ ->
  Client.until ana question >>= fun _ ->
  ask "ana" ~body:{|{"question": 1, "text": "3"}|} "run/answer" >>= fun _ ->
  Client.until ana (fun m -> m.event = "waiting") >>= fun _ ->
  replace "rui" hash >>= fun r ->
  refused "by one who answers" (403, "answers") r;
  replace "eva" hash >>= fun r ->
  refused "by one who watches" (403, "watches") r;
  replace "ana" ~path:"wrong.dol" hash >>= fun r ->
  refused "with faults" (422, "faults") r;
  replace "ana" ~path:"../outside.dol" hash >>= fun r ->
  refused "from elsewhere" (404, "not-found") r;
  let differs = program "input 'go'\nmessage 'begins'\nx = ask 'How often?'\nexecute condition { consume go: _ }\n" in
  replace "ana" hash >>= fun r ->
  refused "another text than was checked" (409, "changed") r;
  replace "ana" differs >>= fun r ->
  refused "one that the run does not begin" (422, "differs") r;
  holds "with the step that differs" true (has_text "How many?" r.body);
  let hash = program (mission ^ "message 'more'\n") in
  replace "ana" hash >>= fun r ->
  status "replaced" 200 r.status;
  ask "ana" "status" >>= fun r ->
  text "the program" "\"changed.dol\"" (Yojson.Safe.to_string (member [ "run"; "program" ] (Client.json r)));
  ask "rui" ~body:{|{"pairs": "go: 1"}|} "run/post" >>= fun _ ->
  Client.until ana (fun m -> m.event = "log" && has_text "says: more" m.data) >>= fun _ ->
  Client.until ana is_over >>= fun _ ->
  Client.leave ana >>= fun () -> acts_of_latest_run ~headers:(by "eva") port >|= fun acts ->
  let replaces = List.filter (has_text "replaces") acts in
  holds "whose it was" true
    (replaces <> [] && List.for_all (fun act -> has_text "ana (steer) replaces the program by " act) replaces)

(* {2 Questions for some of them} *)

let bridge = Result.get_ok (Operators.read "ana steer\nrui answer,pilot\nleo answer\nzoe admin\n")

let by_name name =
  let operator = List.find (fun (o : Operators.operator) -> o.name = Some name) bridge in
  [ ("Authorization", "Bearer " ^ operator.token); ("X-Dolphin-Client", name) ]

let addressed () =
  let to_ prompt = Option.value (Operators.addressee bridge prompt) ~default:"all" in
  let check prompt expected = text prompt expected (to_ prompt) in
  check "pilot: May it dive?" "pilot";
  check "leo : May it?" "leo";
  check "warning: May it?" "all";
  check "May it, pilot: now?" "all";
  check "steer: May it?" "all";
  check "pilot" "all";
  let may name prompt =
    Operators.may_answer bridge (List.find (fun (o : Operators.operator) -> o.name = Some name) bridge) prompt in
  let answers prompt = List.filter (fun name -> may name prompt) [ "ana"; "rui"; "leo"; "zoe" ] in
  Alcotest.(check (list string)) "for the pilot" [ "rui"; "zoe" ] (answers "pilot: May it dive?");
  Alcotest.(check (list string)) "for all" [ "ana"; "rui"; "leo"; "zoe" ] (answers "May it dive?")

(* A question of the script, and then one of a task: the steerer with the helm may answer neither. *)
let questions_for_some folder console =
  let port = Console.port console in
  write (Filename.concat folder "dive.dol")
    "x = confirm 'pilot: May it dive?'\nexecute confirm('pilot: Up again?') | confirm('All well?')\nmessage 'over'\n";
  let ask name ?body path = Client.ask ?body ~headers:(by_name name) ~port ("/api/" ^ path) in
  let to_ m = Yojson.Safe.to_string (member [ "run"; "question"; "to" ] (Yojson.Safe.from_string m.Client.data)) in
  Client.events ~headers:(by_name "ana") ~port "/api/events?client=ana" >>= fun ana ->
  ask "ana" ~body:{|{"program": "dive.dol", "speed": 1}|} "run" >>= fun r ->
  status "started" 200 r.status;
  Client.until ana question >>= fun seen ->
  text "for whom" {|"pilot"|} (to_ (List.hd (List.rev seen)));
  let first = {|{"question": 1, "text": "true"}|} in
  Lwt_list.iter_s (fun name -> ask name ~body:first "run/answer" >|= refused name (403, "addressed")) [ "ana"; "leo" ]
  >>= fun () ->
  ask "rui" ~body:first "run/answer" >>= fun r ->
  status "the pilot" 200 r.status;
  let open_ m = member [ "run"; "questions" ] (Yojson.Safe.from_string m.Client.data) in
  let has_two m = m.Client.event = "status" && match open_ m with `List [ _; _ ] -> true | _ -> false in
  Client.until ana has_two >>= fun _ ->
  let second = {|{"key": "pilot: Up again?", "value": true}|} in
  Lwt_list.iter_s (fun name -> ask name ~body:second "run/post" >|= refused name (403, "addressed")) [ "ana"; "leo" ]
  >>= fun () ->
  ask "leo" ~body:{|{"key": "All well?", "value": true}|} "run/post" >>= fun r ->
  status "for all" 200 r.status;
  ask "zoe" ~body:second "run/post" >>= fun r ->
  status "an admin, without the helm" 200 r.status;
  Client.until ana is_over >>= fun _ ->
  Client.leave ana >>= fun () -> acts_of_latest_run ~headers:(by_name "ana") port >|= fun acts ->
  Alcotest.(check (list string)) "who did it"
    [ "ana (steer) starts the run"; "rui (answer) answers 'pilot: May it dive?': true";
      "leo (answer) answers 'All well?': yes"; "zoe (admin) answers 'pilot: Up again?': yes" ] acts

let shut_out _ console =
  let port = Console.port console in
  let ask name ?body path = Client.ask ?body ~headers:(by_name name) ~port ("/api/" ^ path) in
  Client.events ~headers:(by_name "ana") ~port "/api/events?client=ana" >>= fun ana ->
  ask "ana" ~body:{|{"program": "mission.dol", "speed": 10}|} "run" >>= fun r ->
  status "started" 200 r.status;
  Client.until ana question >>= fun _ ->
  let out name = Printf.sprintf {|{"shut_out": "%s"}|} name in
  ask "ana" ~body:(out "leo") "operators" >>= fun r ->
  refused "who steers" (403, "not-admin") r;
  ask "rui" "operators" >>= fun r ->
  refused "who answers" (403, "not-admin") r;
  ask "zoe" ~body:(out "zoe") "operators" >>= fun r ->
  refused "herself" (404, "not-found") r;
  ask "zoe" ~body:(out "ana") "operators" >>= fun r ->
  status "by an admin" 200 r.status;
  Lwt.catch
    (fun () -> Client.until ana (fun _ -> false) >|= fun _ -> false)
    (fun _ -> Lwt.return_true)
  >>= fun ended ->
  holds "the stream of events ends" true ended;
  ask "ana" "status" >>= fun r ->
  refused "no access" (401, "refused") r;
  ask "zoe" "status" >>= fun r ->
  text "the helm is free" "null" (Yojson.Safe.to_string (member [ "helm"; "holder" ] (Client.json r)));
  ask "zoe" ~body:"{}" "run/stop" >>= fun r ->
  status "the run is stopped by another" 200 r.status;
  let rec over () =
    ask "zoe" "status" >>= fun r ->
    if member [ "run"; "state" ] (Client.json r) = `String "over" then Lwt.return_unit
    else Lwt_unix.sleep 0.02 >>= over
  in
  over () >>= fun () -> acts_of_latest_run ~headers:(by_name "zoe") port >|= fun acts ->
  holds "the journal has it" true (List.mem "zoe (admin) shuts out ana" acts)

(* {2 A reverse proxy} *)

let behind_a_proxy _ console =
  let port = Console.port console in
  let ask ?body headers path = Client.ask ?body ~headers ~port path in
  let user name = ("X-Forwarded-User", name) in
  Alcotest.(check (list string)) "one link, without a token" [ "" ] (List.map fst (Console.links console));
  let token = (List.hd bridge).token in
  Lwt_list.iter_s
    (fun (what, headers) -> ask headers "/api/status" >|= refused what (401, "refused"))
    [ ("without the header", []); ("unknown", [ user "mallory" ]); ("by a token", [ ("Authorization", "Bearer " ^ token) ]);
      ("twice", [ user "ana"; user "zoe" ]); ("empty", [ user "" ]) ]
  >>= fun () ->
  ask [] ("/?token=" ^ token) >>= fun r ->
  status "a token is no way in" 200 r.status;
  let host = ("Host", "console.example.org") in
  ask [ host; user "ana"; ("Origin", "https://console.example.org") ] "/api/status" >>= fun r ->
  status "by the proxy's name" 200 r.status;
  ask [ host; user "ana"; ("Origin", "https://evil.example") ] "/api/status" >>= fun r ->
  refused "a foreign page" (403, "refused") r;
  ask [ host; user "rui" ] ~body:"{}" "/api/run/stop" >>= fun r ->
  refused "with the role of the file" (403, "answers") r;
  ask [ host; user "zoe" ] "/api/operators" >|= fun r -> status "an admin" 200 r.status

let proxy_header () =
  let check what expected = holds what expected (Result.is_ok (Access.check_proxy_header what)) in
  List.iter (fun what -> check what true) [ "X-Forwarded-User"; "x-remote-user" ];
  List.iter (fun what -> check what false) [ ""; "x-"; "Host"; "X-Dolphin-Client"; "X-A b"; "X-A:"; "Authorization" ];
  let loopback text = Access.is_loopback (Unix.inet_addr_of_string text) in
  List.iter (fun text -> holds text true (loopback text)) [ "127.0.0.1"; "127.1.2.3"; "::1" ];
  List.iter (fun text -> holds text false (loopback text)) [ "0.0.0.0"; "::"; "192.168.1.5"; "128.0.0.1"; "fe80::1" ]

let answers_and_posts _ port =
  let command ?(client = "first") path body =
    Client.ask ~headers:[ ("X-Dolphin-Client", client) ] ~body ~port ("/api/" ^ path) in
  Client.watch ~port "first" >>= fun first ->
  Client.watch ~port "second" >>= fun second ->
  command "run" {|{"program": "mission.dol", "speed": 10}|} >>= fun _ ->
  Client.until first question >>= fun _ ->
  Client.until second question >>= fun _ ->
  command ~client:"second" "run/answer" {|{"question": 1, "text": "3"}|} >>= fun r ->
  refused "another page has the helm" (409, "no-helm") r;
  command "run/answer" {|{"question": 2, "text": "3"}|} >>= fun r ->
  refused "no such question" (409, "answered") r;
  command "run/answer" {|{"question": 1, "text": "3 +"}|} >>= fun r ->
  status "no expression" 200 r.status;
  let is_second m =
    question m && member [ "run"; "question"; "number" ] (Yojson.Safe.from_string m.Client.data) = `Int 2 in
  Client.until first is_second >>= fun seen ->
  let again = Yojson.Safe.from_string (List.hd (List.rev seen)).data in
  holds "is asked again, with the reason" true (member [ "run"; "question"; "refused" ] again <> `Null);
  command "run/answer" {|{"question": 2, "text": "3"}|} >>= fun r ->
  status "answered" 200 r.status;
  command "run/answer" {|{"question": 2, "text": "4"}|} >>= fun r ->
  refused "once" (409, "answered") r;
  Client.until first (fun m -> m.event = "waiting") >>= fun _ ->
  command "run" {|{"program": "short.dol"}|} >>= fun r ->
  refused "one run at a time" (409, "busy") r;
  command "run/post" {|{"key": "stop", "value": true}|} >>= fun r ->
  refused "not declared" (422, "not-posted") r;
  command "helm" {|{"want": "give-up"}|} >>= fun _ ->
  command ~client:"second" "run/post" {|{"pairs": "go: 'north'"}|} >>= fun r ->
  status "posted by the other" 200 r.status;
  Client.until second is_over >>= fun seen ->
  let ended = Yojson.Safe.from_string (List.hd (List.rev seen)).data in
  text "how it ends" {|"completed"|} (Yojson.Safe.to_string (member [ "run"; "outcome"; "how" ] ended));
  command ~client:"second" "run/stop" "{}" >>= fun r ->
  refused "nothing to stop" (409, "no-run") r;
  Lwt_list.iter_s Client.leave [ first; second ]

(* What a page needs to ask: where the question stands, whether it takes yes or no, what the fleet says may come. *)
let what_is_asked folder port =
  let asked (m : Client.message) = member [ "run"; "question" ] (Yojson.Safe.from_string m.data) in
  let question program =
    write (Filename.concat folder "asks.dol") program;
    write (Filename.concat folder "asks.fleet") "input 'go', 'north', either(1, 'south'), times 2\n";
    Client.watch ~port "first" >>= fun first ->
    Client.ask ~body:{|{"program": "asks.dol", "people": true}|} ~port "/api/run" >>= fun _ ->
    Client.until first question >>= fun seen ->
    let found = asked (List.hd (List.rev seen)) in
    Client.ask ~body:"{}" ~port "/api/run/stop" >>= fun _ ->
    Client.until first is_over >>= fun _ ->
    Client.leave first >|= fun () ->
    String.concat " " (List.map (fun name -> Yojson.Safe.to_string (member [ name ] found)) [ "prompt"; "kind"; "at" ])
  in
  question "x = 1\ny = ask 'How many?'\n" >>= fun found ->
  text "ask" {|"How many?" "value" "2:5"|} found;
  question "if (confirm 'Now?') message 'now'\n" >>= fun found ->
  text "confirm" {|"Now?" "truth" "1:5"|} found;
  question "execute idle(1.hour) | (confirm('Go?') >> action { })\n" >>= fun found ->
  text "confirm as a task" {|"Go?" "truth" "1:25"|} found;
  write (Filename.concat folder "asks.dol") "input 'go', 'stop'\n";
  Client.ask ~port "/api/world?program=asks.dol" >|= fun r ->
  text "what may come" {|{"go":["'north'","'south'","1"]}|}
    (Yojson.Safe.to_string (member [ "suggested" ] (Client.json r)))

(* All questions that are open, with the time at which the innermost and the outer time limits end them. *)
let open_questions folder port =
  write (Filename.concat folder "open.dol")
    ("execute ((confirm('Left?') | (confirm('Middle?') within 2.hour)) within 1.hour)\n"
     ^ "  | (confirm('Right?') during 3.hour)\nx = ask 'And now?'\n");
  let listed (m : Client.message) =
    match member [ "run"; "questions" ] (Yojson.Safe.from_string m.data) with
    | `List found when m.event = "status" -> Yojson.Safe.to_string (`List found)
    | _ -> ""
  in
  let post body = Client.ask ~body ~port "/api/run/post" in
  Client.watch ~port "first" >>= fun first ->
  Client.ask ~body:{|{"program": "open.dol", "people": true, "speed": 1}|} ~port "/api/run" >>= fun r ->
  status "it starts" 200 r.status;
  Client.until first (fun m -> has_text "Right?" (listed m)) >>= fun seen ->
  text "three questions"
    ({|[{"prompt":"Left?","of":"task","at":"1:11","until":3600,"to":null},|}
     ^ {|{"prompt":"Middle?","of":"task","at":"1:31","until":3600,"to":null},|}
     ^ {|{"prompt":"Right?","of":"task","at":"2:6","until":10800,"to":null}]|})
    (listed (List.hd (List.rev seen)));
  post {|{"key": "Right?", "value": true}|} >>= fun r ->
  status "any of them is answered" 200 r.status;
  Client.until first (fun m -> has_text "Left?" (listed m) && not (has_text "Right?" (listed m))) >>= fun _ ->
  post {|{"key": "Middle?", "value": true}|} >>= fun _ ->
  post {|{"key": "Left?", "value": true}|} >>= fun _ ->
  Client.until first (fun m -> has_text {|"And now?","of":"script"|} (listed m)) >>= fun _ ->
  Client.ask ~body:"{}" ~port "/api/run/stop" >>= fun _ ->
  Client.until first is_over >>= fun seen ->
  text "none at the end" "[]" (listed (List.hd (List.rev seen)));
  Client.leave first

(* What the program's variables are on the map, and the way of a plan that it describes. *)
let on_the_map folder port =
  write (Filename.concat folder "chart.dol")
    ("quay = location 41.0, -8.0\nzones = [quay ^ 100.m, 1]\nv = pick { type 'UUV' }\n"
     ^ "execute imcPlan { planName 'there'; goTo location: quay }\n");
  write (Filename.concat folder "chart.fleet") "vehicle 'a', { type 'UUV'; at 41.0001, -8.0 }\n";
  write (Filename.concat folder "buoys.geojson")
    {|{"type":"Feature","properties":{"name":1},"geometry":{"type":"Point","coordinates":[-8,41]}}|};
  Client.watch ~port "first" >>= fun first ->
  Client.ask ~body:{|{"program": "chart.dol"}|} ~port "/api/run" >>= fun r ->
  status "started" 200 r.status;
  Client.until first is_over >>= fun seen ->
  let last name =
    let told = List.hd (List.rev (data (events name seen))) in
    Yojson.Safe.to_string (member [ name ] (Yojson.Safe.from_string told)) in
  text "places" {|[{"name":"quay","position":[41,-8]},{"name":"zones[0]","centre":[41,-8],"radius":100}]|} (last "places");
  text "way" {|{"vehicle":"a","plan":"there","path":[[41.0001,-8],[41,-8]]}|} (last "way");
  Client.leave first >>= fun () ->
  Client.ask ~port "/api/layer?path=buoys.geojson" >>= fun r ->
  text "a layer" {|{"shapes":[{"name":"1","position":[41,-8]}]}|} (String.trim r.body);
  Client.ask ~port "/api/file?path=buoys.geojson" >>= fun r ->
  refused "is no text" (400, "bad-request") r;
  write (Filename.concat folder "wrong.gpx") "<gpx><wpt lat='91' lon='0'/></gpx>";
  Client.ask ~port "/api/layer?path=wrong.gpx" >>= fun r ->
  refused "no layer" (422, "no-layer") r;
  Client.ask ~port "/api/tile?path=../outside.mbtiles&zoom=0&column=0&row=0" >>= fun r ->
  refused "no tile from elsewhere" (404, "not-found") r;
  Client.ask ~verb:"PUT" ~body:{|{"path": "buoys.geojson", "text": ""}|} ~port "/api/file" >>= fun r ->
  refused "is not edited" (400, "bad-request") r;
  Client.ask ~port "/api/status" >|= fun r -> text "no tiles" "null" (Yojson.Safe.to_string (member [ "tiles" ] (Client.json r)))

let hexadecimal text = String.concat "" (List.map (fun c -> Printf.sprintf "%02x" (Char.code c)) (List.of_seq (String.to_seq text)))

let drawn folder port =
  let source = {|// \u00e9\nquay = location(41.0, -8.0)\nzone = quay ^ 100.m\n|} in
  Client.ask ~body:(Printf.sprintf {|{"path": "short.dol", "text": "%s"}|} source) ~port "/api/shapes" >>= fun r ->
  text "shapes"
    ({|{"shapes":[{"name":"quay","from":12,"to":32,"kind":"position","points":[{"at":[41,-8],|}
     ^ {|"latitude":{"from":21,"to":25,"negative":true},"longitude":{"from":27,"to":31,"negative":true}}]},|}
     ^ {|{"name":"zone","from":40,"to":52,"kind":"circle","points":[{"at":[41,-8]}],"radius":100,|}
     ^ {|"metres":{"from":47,"to":50,"negative":false}}],"first":5}|})
    (String.trim r.body);
  Client.ask ~body:{|{"path": "short.dol", "text": "a ="}|} ~port "/api/shapes" >>= fun r ->
  refused "a text with faults" (422, "faults") r;
  let import ?(path = "sub/harbour.geojson") contents =
    Client.ask ~verb:"PUT" ~body:(Printf.sprintf {|{"path": "%s", "contents": "%s"}|} path contents) ~port "/api/layer" in
  let buoy = {|{"type":"Feature","properties":{"name":"buoy"},"geometry":{"type":"Point","coordinates":[-8,41]}}|} in
  import (hexadecimal buoy) >>= fun r ->
  text "imported" {|{"path":"sub/harbour.geojson","names":["buoy"],"notes":[]}|} (String.trim r.body);
  import (hexadecimal buoy) >>= fun r ->
  status "the same again" 200 r.status;
  import (hexadecimal (buoy ^ " ")) >>= fun r ->
  refused "another file of this name" (409, "exists") r;
  import ~path:"other.gpx" (hexadecimal buoy) >>= fun r ->
  refused "no map" (422, "no-layer") r;
  holds "is not kept" false (Sys.file_exists (Filename.concat folder "other.gpx"));
  let refuse what path expected = import ~path (hexadecimal buoy) >|= refused what expected in
  refuse "a program" "new.dol" (400, "bad-request") >>= fun () ->
  refuse "tiles" "new.mbtiles" (400, "bad-request") >>= fun () ->
  refuse "elsewhere" "../new.geojson" (404, "not-found") >>= fun () ->
  refuse "hidden" ".new.geojson" (404, "not-found") >>= fun () ->
  import "4" >>= fun r ->
  refused "half a byte" (400, "bad-request") r;
  import ~path:"large.geojson" (String.make (2 * 1024 * 1024 + 2) '2') >>= fun r ->
  Lwt.return (refused "too large" (413, "too-large") r)

let tiles () =
  let good url = holds url true (Access.check_tiles url = Ok url) in
  let bad url = holds url true (Result.is_error (Access.check_tiles url)) in
  List.iter good [ "https://tile.example/{z}/{x}/{y}.png"; "http://127.0.0.1:8080/{z}/{y}/{x}" ];
  List.iter bad
    [ ""; "tile.example/{z}/{x}/{y}.png"; "https://tile.example/{z}/{x}.png"; "https://a; script-src */{z}/{x}/{y}";
      "javascript://a/{z}/{x}/{y}"; "https:///{z}/{x}/{y}" ];
  let policy = List.assoc "Content-Security-Policy" (Access.headers ~tiles:(Some "https://tile.example/{z}/{x}/{y}.png")) in
  holds "tiles may be loaded" true
    (List.mem " img-src 'self' data: https://tile.example" (String.split_on_char ';' policy))

let stopped _ port =
  Client.watch ~port "first" >>= fun first ->
  Client.ask ~body:{|{"program": "mission.dol", "answers": ["1"], "speed": 10}|} ~port "/api/run" >>= fun _ ->
  Client.until first (fun m -> m.event = "waiting") >>= fun _ ->
  Client.ask ~body:"{}" ~port "/api/run/stop" >>= fun _ ->
  Client.until first is_over >>= fun seen ->
  let ended = Yojson.Safe.from_string (List.hd (List.rev seen)).data in
  text "interrupted" {|"interrupted"|} (Yojson.Safe.to_string (member [ "run"; "outcome"; "how" ] ended));
  Client.leave first

(* From the present of the run on, and only as long as its program is the one that runs. *)
let outlook folder port =
  let file name text = write (Filename.concat folder name) text in
  let fleet = "vehicle 'a', { type 'UUV' }\nplan 'survey', { duration 1.hour, 90.min }\n" in
  let member path (m : Client.message) = member ("run" :: "outlook" :: path) (Yojson.Safe.from_string m.data) in
  let seconds path m = match member path m with `Int n -> float_of_int n | `Float x -> x | _ -> Float.nan in
  let has path (m : Client.message) = m.event = "status" && member path m <> `Null in
  let begun program = Client.ask ~body:(Printf.sprintf {|{"program": "%s", "speed": 10}|} program) ~port "/api/run" in
  let stop () = Client.ask ~body:"{}" ~port "/api/run/stop" in
  let last seen = List.hd (List.rev seen) in
  file "twice.dol" "v = pick { count 1 }\nexecute v: task('survey') >> task('survey')\n";
  file "twice.fleet" fleet;
  Client.watch ~port "first" >>= fun first ->
  begun "twice.dol" >>= fun _ ->
  Client.until first (fun m -> has [ "over" ] m && seconds [ "from"; "transitions" ] m >= 4.) >>= fun seen ->
  let found = last seen in
  let within least most x = least <= x && x < most in
  holds "over after two hours" true (within 7200. 7300. (seconds [ "over"; "earliest" ] found));
  holds "over by three hours" true (within 10800. 10900. (seconds [ "over"; "latest" ] found));
  text "nothing goes wrong" "[]" (Yojson.Safe.to_string (member [ "violated" ] found));
  text "but by faults" {|["no unhandled error"]|} (Yojson.Safe.to_string (member [ "by_faults" ] found));
  let task =
    match member [ "running" ] found with
    | `List [ `Assoc task ] -> task
    | _ -> Alcotest.fail "one task runs"
  in
  let due name = match List.assoc name task with `Int n -> float_of_int n | `Float x -> x | _ -> Float.nan in
  holds "whose task it is" true (List.assoc "vehicle" task = `String "a" && List.assoc "plan" task = `String "survey");
  holds "due after an hour" true (within 3600. 3700. (due "earliest"));
  holds "due by an hour and a half" true (within 5400. 5500. (due "latest"));
  text "all was looked at" "true" (Yojson.Safe.to_string (member [ "complete" ] found));
  stop () >>= fun _ ->
  Client.until first is_over >>= fun seen ->
  text "none at the end" "null" (Yojson.Safe.to_string (member [] (last seen)));
  let waits = "input 'go'\nv = pick { count 1 }\nexecute v: task('survey') >> condition { poll go: true }\n" in
  file "twice.dol" waits;
  begun "twice.dol" >>= fun _ ->
  Client.until first (has [ "from" ]) >>= fun _ ->
  file "twice.dol" (waits ^ "message 'another end'\n");
  Client.ask ~body:{|{"key": "go", "value": true}|} ~port "/api/run/post" >>= fun _ ->
  Client.until first (has [ "error" ]) >>= fun seen ->
  text "another program" {|"the program has changed since the run began"|}
    (Yojson.Safe.to_string (member [ "error" ] (last seen)));
  stop () >>= fun _ ->
  Client.until first is_over >>= fun _ -> Client.leave first

(* The end of what a stuck program executes is told as the terminal tells it. *)
let stuck folder port =
  write (Filename.concat folder "home.dol")
    "onInterrupt task('home')\nv = pick { type 'UUV' }\nexecute condition { poll never: 1 }\n";
  Client.watch ~port "first" >>= fun first ->
  Client.ask ~body:{|{"program": "home.dol"}|} ~port "/api/run" >>= fun r ->
  status "started" 200 r.status;
  Client.until first is_over >>= fun seen ->
  let log = List.map (fun line -> member [ "text" ] (Yojson.Safe.from_string line)) (data (events "log" seen)) in
  let words = List.map (fun line -> Str.replace_first (Str.regexp "^.*program  *") "" (Yojson.Safe.Util.to_string line)) in
  let of_program = List.filter (fun line -> Str.string_match (Str.regexp "is ") line 0) (words log) in
  Alcotest.(check (list string)) "told" [ "is stuck: executes onInterrupt"; "is stuck" ] of_program;
  Client.leave first

(* A run that waits for a vehicle, which is not there yet or is busy, is not stuck: neither while it is stopped nor in
   its replay. *)
let interrupted_is_not_stuck folder port =
  let vehicles =
    "vehicle 'a', { type 'UUV' }\n"
    ^ "vehicle 'late', { type 'UAV'; joins 5.hours }\nplan 'survey', { duration 3.hours }\n" in
  let one (name, program) =
    let file = name ^ ".dol" in
    write (Filename.concat folder file) program;
    write (Filename.concat folder (name ^ ".fleet")) vehicles;
    Client.watch ~port "first" >>= fun first ->
    Client.ask ~body:(Printf.sprintf {|{"program": "%s", "speed": 1}|} file) ~port "/api/run" >>= fun r ->
    status "started" 200 r.status;
    Client.until first (fun m -> m.event = "journal" && has_text "transition" m.data) >>= fun _ ->
    Lwt_unix.sleep 0.2 >>= fun () ->
    Client.ask ~body:"{}" ~port "/api/run/stop" >>= fun r ->
    status "stopped" 200 r.status;
    Client.until first is_over >>= fun seen ->
    Client.leave first >>= fun () ->
    let log seen = String.concat "\n" (data (events "log" seen)) in
    holds (name ^ ": live: " ^ log seen) false (has_text "stuck" (log seen));
    Client.ask ~port "/api/runs" >>= fun r ->
    let runs = Yojson.Safe.Util.to_list (member [ "runs" ] (Client.json r)) in
    let run = List.find (fun run -> member [ "program" ] run = `String file) runs in
    text "kept as" {|"interrupted"|} (Yojson.Safe.to_string (member [ "state" ] run));
    Client.events ~port ("/api/replay?run=" ^ Yojson.Safe.Util.to_string (member [ "run" ] run)) >>= fun replay ->
    Client.until replay (fun m -> m.event = "end") >>= fun seen ->
    holds (name ^ ": replayed: " ^ log seen) false (has_text "stuck" (log seen));
    holds "as interrupted" true (has_text "interrupted" (log seen));
    Client.leave replay
  in
  Lwt_list.iter_s one
    [ ("picks", "message 'begins'\nv = pick { type 'UAV'; timeout 6.hours }\nexecute task('survey')[v]\n");
      ("recruits",
       "v = pick { type 'UUV' }\n"
       ^ "execute task('survey')[v] | recruit { type 'UAV' } then { w -> task('survey')[w] }\n");
      ("waits", "v = pick { type 'UUV' }\nexecute task('survey')[v] | condition { poll never: 1 }\n");
      ("home", "onInterrupt task('survey')\nmessage 'begins'\nv = pick { type 'UAV'; timeout 6.hours }\n") ]

let faults _ port =
  let start body = Client.ask ~body ~port "/api/run" in
  start {|{"program": "wrong.dol"}|} >>= fun r ->
  refused "a program with a fault" (422, "faults") r;
  status "where" 1 (List.length (Yojson.Safe.Util.to_list (member [ "error"; "diagnostics" ] (Client.json r))));
  start {|{"program": "none.dol"}|} >>= fun r ->
  refused "none" (404, "not-found") r;
  start {|{"program": "short.dol", "speed": -1}|} >>= fun r ->
  refused "a speed" (400, "bad-request") r;
  start {|{"program": 1}|} >>= fun r ->
  refused "a number" (400, "bad-request") r;
  Client.ask ~body:{|{"run": "none"}|} ~port "/api/run/resume" >>= fun r ->
  refused "nothing to resume" (404, "not-found") r;
  Client.ask ~verb:"DELETE" ~body:"{}" ~port "/api/status" >>= fun r ->
  refused "a method" (405, "bad-method") r;
  Client.ask ~port "/api/none" >|= refused "a path" (404, "not-found")

(* {1 Bounds} *)

let waiting = ref 0

let echo ?rank limits f () =
  let reply (r : Request.t) =
    (if List.mem "waits" r.path then (incr waiting; Lwt_unix.sleep 60.) else Lwt.return_unit) >|= fun () ->
    Dolphin_http.Response.text ~kind:"text/plain" 200 (string_of_int (String.length r.body)) in
  let server = Result.get_ok (Server.start ~limits ?rank ~port:0 reply) in
  Lwt_main.run (Lwt.finalize (fun () -> Lwt_unix.with_timeout 120. (fun () -> f server (Server.port server)))
                  (fun () -> Server.close server))

let sizes =
  echo { Server.limits with head = 500; body = 100 } (fun _ port ->
      Client.raw ~port ("GET /" ^ String.make 600 'x' ^ " HTTP/1.1\r\n\r\n") >>= fun reply ->
      begins "413" reply;
      Client.raw ~port (String.make 10_000 'x') >>= fun reply ->
      begins "413" reply;
      Client.raw ~port "POST / HTTP/1.1\r\nContent-Length: 101\r\n\r\n" >>= fun reply ->
      begins "413" reply;
      Client.raw ~port ("POST / HTTP/1.1\r\nConnection: close\r\nContent-Length: 100\r\n\r\n" ^ String.make 100 'x')
      >>= fun reply ->
      begins "200" reply;
      Client.raw ~port "GET / HTTP/1.1\r\n\r\nGET / HTTP/1.1\r\nConnection: close\r\n\r\n" >|= fun reply ->
      status "two requests at once" 2 (List.length (Str.full_split (Str.regexp_string "HTTP/1.1 200") reply) / 2))

let patience =
  echo { Server.limits with patience = 0.2; idle = 0.3 } (fun _ port ->
      Client.raw ~port "GET / HTTP/1.1\r\nslow" >>= fun reply ->
      text "who is slow hears nothing" "" reply;
      Client.raw ~port "" >|= text "nor who is silent" "")

(* Until the server has so many connections. *)
let rec have server n =
  if Server.connections server = n then Lwt.return_unit else Lwt_unix.sleep 0.01 >>= fun () -> have server n

let get path = Printf.sprintf "GET /%s HTTP/1.1\r\nConnection: close\r\n\r\n" path

(* Idle connections of unknown clients end for new ones; clients of other ranks keep their places. *)
let connections =
  let connections = function Server.Unknown -> 3 | Guest -> 1 | Trusted -> 1 in
  let rank (r : Request.t) : Server.rank =
    match r.path with "trusted" :: _ -> Trusted | "guest" :: _ -> Guest | _ -> Unknown in
  echo ~rank { Server.limits with connections } (fun server port ->
      let idle _ = Client.connect port in
      Lwt_list.map_s idle [ 1; 2; 3 ] >>= fun sockets ->
      have server 3 >>= fun () ->
      Client.raw ~port (get "") >>= fun reply ->
      begins "200" reply;
      Lwt_list.map_s idle (List.init 20 Fun.id) >>= fun others ->
      have server 3 >>= fun () ->
      let slow = Client.raw ~port (get "guest/waits") in
      let rec is_served () = if !waiting = 1 then Lwt.return_unit else Lwt_unix.sleep 0.01 >>= is_served in
      is_served () >>= fun () ->
      Client.raw ~port (get "guest") >>= fun reply ->
      begins "503" reply;
      Client.raw ~port (get "trusted") >>= fun reply ->
      begins "200" reply;
      holds "the guest waits" true (Lwt.is_sleeping slow);
      Lwt.cancel slow;
      Lwt_list.iter_p Lwt_unix.close (sockets @ others))

let rate =
  echo { Server.limits with rate = 3 } (fun _ port ->
      let request = "GET / HTTP/1.1\r\n\r\n" in
      Client.raw ~port (String.concat "" (List.init 300 (fun _ -> request))) >|= fun reply ->
      begins "200" reply;
      holds "too many in a second" true
        (match Str.search_forward (Str.regexp_string "HTTP/1.1 429") reply 0 with _ -> true | exception Not_found -> false))

(* Large replies that nobody reads take memory: there is a limit for each rank. *)
let large_replies () =
  let reply (r : Request.t) =
    let length = if List.mem "large" r.path then 4_000_000 else 10 in
    Lwt.return (Dolphin_http.Response.text ~kind:"text/plain" 200 (String.make length 'x')) in
  let rank (r : Request.t) : Server.rank = if List.mem "guest" r.path then Guest else Trusted in
  let limits = { Server.limits with unsent = 10_000_000 } in
  let server = Result.get_ok (Server.start ~limits ~rank ~port:0 reply) in
  let port = Server.port server in
  let unread () =
    Client.connect port >>= fun socket ->
    let request = get "guest/large" in
    Lwt_unix.write_string socket request 0 (String.length request) >>= fun _ ->
    Lwt_unix.wait_read socket >|= fun () -> socket in
  Lwt_main.run
    (Lwt_list.map_s unread [ (); () ] >>= fun sockets ->
     let answered what expected path =
       Client.raw ~port (get path) >|= fun reply -> text what expected (String.sub reply 9 3) in
     answered "a third large one" "503" "guest/large" >>= fun () ->
     answered "a small one" "200" "guest" >>= fun () ->
     answered "of another rank" "200" "large" >>= fun () ->
     Lwt_list.iter_s Lwt_unix.close sockets >>= fun () ->
     let rec again n =
       Client.raw ~port (get "guest/large") >>= fun reply ->
       if String.sub reply 9 3 = "200" then Lwt.return_unit
       else if n = 0 then Alcotest.fail "large replies stay refused"
       else Lwt_unix.sleep 0.05 >>= fun () -> again (n - 1) in
     again 100 >>= fun () -> Server.close server)

(* {1 TLS} *)

let encrypted limits f () =
  in_folder (fun _ ->
      let certificate = match Certificate.own ~name:"127.0.0.1" with
        | Ok certificate -> certificate | Error e -> Alcotest.fail (String.concat "; " (Dolphin_app.Error.sentences e)) in
      let reply (r : Request.t) =
        let length = if List.mem "large" r.path then 3_000_000 else 10 in
        Lwt.return (Dolphin_http.Response.text ~kind:"text/plain" 200 (String.make length 'x')) in
      let server = Result.get_ok (Server.start ~limits ~tls:certificate.context ~port:0 reply) in
      Lwt_main.run (Lwt.finalize (fun () -> Lwt_unix.with_timeout 60. (fun () -> f certificate (Server.port server)))
                      (fun () -> Server.close server)))

let client = lazy (Ssl.init (); Ssl.create_context Ssl.SSLv23 Ssl.Client_context)

let connect_encrypted port = Client.connect port >>= fun socket -> Lwt_ssl.ssl_connect socket (Lazy.force client)

(* The whole reply, read piece by piece with a pause after each. *)
let ask_encrypted ?(pause = 0.) port path =
  connect_encrypted port >>= fun channel ->
  let request = Bytes.of_string (get path) and piece = Bytes.create 65_536 and found = Buffer.create 1000 in
  Lwt_ssl.write channel request 0 (Bytes.length request) >>= fun _ ->
  let rec read () =
    Lwt.catch (fun () -> Lwt_ssl.read channel piece 0 (Bytes.length piece)) (fun _ -> Lwt.return 0) >>= function
    | 0 -> Lwt_ssl.close channel >|= fun () -> Buffer.contents found
    | n -> Buffer.add_subbytes found piece 0 n; Lwt_unix.sleep pause >>= read
  in
  read ()

let tls =
  encrypted { Server.limits with patience = 1. } (fun certificate port ->
      connect_encrypted port >>= fun channel ->
      let shown = Option.map Ssl.get_certificate (Lwt_ssl.ssl_socket channel) in
      let hexadecimal c = Printf.sprintf "%02x" (Char.code c) in
      let digest c =
        String.concat "" (List.map hexadecimal (List.of_seq (String.to_seq (Ssl.digest `SHA256 c)))) in
      Alcotest.(check (option string)) "its fingerprint" (Some certificate.fingerprint) (Option.map digest shown);
      Lwt_ssl.close channel >>= fun () ->
      let again = Result.get_ok (Certificate.own ~name:"127.0.0.1") in
      text "kept" certificate.fingerprint again.fingerprint;
      let other = Result.get_ok (Certificate.own ~name:"here.example") in
      holds "of another name" true (other.fingerprint <> again.fingerprint);
      let folder = Filename.concat (Sys.getenv "XDG_STATE_HOME") "dolphin/certificates" in
      Alcotest.(check (list int)) "only its owner reads the keys" [ 0o600; 0o600 ]
        (List.map (fun name -> (Unix.stat (Filename.concat folder name)).st_perm) (Array.to_list (Sys.readdir folder)));
      let key_alone = Filename.concat folder "wrong.pem" in
      write key_alone "no certificate";
      holds "what is none is refused" true (Result.is_error (Certificate.load ~certificate:key_alone ~key:key_alone));
      ask_encrypted port "" >>= fun reply ->
      begins "200" reply;
      ask_encrypted ~pause:0.01 port "large" >>= fun reply ->
      holds "all of it" true (String.length reply > 3_000_000);
      Client.raw ~port (get "") >>= fun reply ->
      holds "what is not encrypted is not answered" false (has_text "200 OK" reply);
      (* One that does not go on with the handshake does not keep others waiting. *)
      Client.connect port >>= fun silent ->
      ask_encrypted port "" >>= fun reply ->
      begins "200" reply;
      Client.raw ~port "\x16\x03\x01" >>= fun reply ->
      text "cut off" "" reply;
      Lwt_unix.close silent)

let handshakes =
  encrypted { Server.limits with handshakes = 3 } (fun _ port ->
      let rec until_refused n =
        if n = 0 then Lwt.return_false
        else
          Lwt.catch (fun () -> ask_encrypted port "" >|= fun reply -> reply = "") (fun _ -> Lwt.return_true) >>= function
          | true -> Lwt.return_true
          | false -> until_refused (n - 1)
      in
      until_refused 20 >>= fun refused ->
      holds "too many in a second" true refused;
      Lwt_unix.sleep 1.1 >>= fun () -> ask_encrypted port "" >|= begins "200")

(* Bytes of a fixed seed, among them pieces of requests. *)
let nonsense random =
  let pieces =
    [| "GET "; "POST /api/run"; " HTTP/1.1\r\n"; "Host: 127.0.0.1\r\n"; "\r\n"; "Content-Length: 5\r\n"; "%"; "{";
       "\000" |]
  in
  let piece _ =
    if Random.State.int random 3 = 0 then String.init 8 (fun _ -> Char.chr (Random.State.int random 256))
    else pieces.(Random.State.int random (Array.length pieces)) in
  String.concat "" (List.init (1 + Random.State.int random 8) piece) ^ "\r\n\r\n"

let malformed _ port =
  let random = Random.State.make [| 18 |] in
  let one text =
    Client.raw ~no_more:true ~port text >|= fun reply ->
    holds (String.escaped text) true (String.length reply < 12 || reply.[9] = '4' || reply.[9] = '5') in
  let rec rounds n =
    if n = 0 then Lwt.return_unit
    else Lwt_list.iter_p one (List.init 50 (fun _ -> nonsense random ^ "x HTTP/9\r\n\r\n")) >>= fun () -> rounds (n - 1)
  in
  rounds 200 >>= fun () ->
  Client.ask ~port "/api/status" >|= fun r ->
  text "nothing happened" "null" (Yojson.Safe.to_string (member [ "run" ] (Client.json r)))

(* {1 The helm} *)

let the_helm () =
  let helm h = match Helm.holder h with Some name -> name | None -> "nobody" in
  let h = Result.get_ok (Helm.command Helm.free "a") in
  text "by its first command" "a" (helm h);
  holds "the other watches" true (Result.is_error (Helm.command h "b"));
  let h = Helm.ask (Helm.ask h "b") "c" in
  text "who asks waits" "a" (helm h);
  let h = Helm.give_up h "a" in
  text "who asked first" "b" (helm h);
  let h = Helm.give_up h "c" in
  text "who does not want it any more" "nobody" (helm (Helm.give_up h "b"));
  let h = Helm.force (Helm.ask (Helm.ask h "a") "d") "d" in
  text "taken by force" "d" (helm h);
  Alcotest.(check (option string)) "from whom" (Some "b") (Helm.taken_from h);
  text "the other still asks" "a" (helm (Helm.give_up h "d"));
  List.iter (fun key -> holds key false (Visitors.is_key key)) [ ""; "a b"; String.make 65 'a'; "a\n" ];
  let v = Visitors.make () in
  text "one key, one name" (Visitors.name v Steers "a") (Visitors.name v Steers "a");
  holds "a watcher has another" true (Visitors.name v Steers "a" <> Visitors.name v Watches "a");
  holds "and so has another key" true (Visitors.name v Steers "a" <> Visitors.name v Steers "b");
  let public = Visitors.name v Steers "a" in
  holds "the name is no key" true (Visitors.name v Steers public <> public)

let role_name (m : Client.message) = Yojson.Safe.Util.to_string (member [ "client" ] (Yojson.Safe.from_string m.data))

(* Two steer. Stop without the helm; the helm by force; a page that vanishes. *)
let stop_without_helm _ port =
  let command ~client path body =
    Client.ask ~headers:[ ("X-Dolphin-Client", client) ] ~body ~port ("/api/" ^ path) in
  let look key =
    Client.watch ~port key >>= fun w ->
    Client.until w (fun m -> m.event = "role") >|= fun seen -> (w, role_name (List.hd (List.rev seen))) in
  look "first" >>= fun (first, first_name) ->
  look "second" >>= fun (second, second_name) ->
  holds "names are no keys" true (first_name <> "first" && first_name <> second_name);
  let holder () =
    Client.ask ~port "/api/status" >|= fun r -> Yojson.Safe.to_string (member [ "helm"; "holder" ] (Client.json r)) in
  command ~client:"first" "run" {|{"program": "mission.dol", "answers": ["1"], "speed": 10}|} >>= fun r ->
  status "begun" 200 r.status;
  holder () >>= fun found ->
  text "who has begun has the helm" (Printf.sprintf "%S" first_name) found;
  command ~client:first_name "run/post" {|{"pairs": "go: 1"}|} >>= fun r ->
  refused "by the public name" (409, "no-helm") r;
  command ~client:"second" "helm" {|{"want": "force"}|} >>= fun r ->
  status "by force" 200 r.status;
  Client.until first (fun m -> m.event = "log" && has_text "takes the helm" m.data) >>= fun _ ->
  holder () >>= fun found ->
  text "the other has it" (Printf.sprintf "%S" second_name) found;
  let before = Unix.gettimeofday () in
  command ~client:"first" "run/stop" {|{"all": false}|} >>= fun r ->
  status "Stop without the helm" 200 r.status;
  Client.until first is_over >>= fun _ ->
  holds "at once" true (Unix.gettimeofday () -. before < 2.);
  command ~client:"first" "helm" {|{"want": "take"}|} >>= fun _ ->
  Client.leave second >>= fun () ->
  let falls (m : Client.message) =
    m.event = "status"
    && member [ "helm"; "holder" ] (Yojson.Safe.from_string m.data) = `String first_name in
  Client.until first falls >>= fun _ -> Client.leave first

(* Two who press Stop at the same time do not end the way home. *)
let stop_twice folder port =
  write (Filename.concat folder "home.dol")
    "onInterrupt task('home')\nv = pick { type 'UUV' }\nexecute idle(1.hour)\n";
  Client.watch ~port "first" >>= fun first ->
  Client.ask ~body:{|{"program": "home.dol", "speed": 2}|} ~port "/api/run" >>= fun r ->
  status "started" 200 r.status;
  Client.until first (fun m -> m.event = "journal" && has_text "transition" m.data) >>= fun _ ->
  let stop body = Client.ask ~body ~port "/api/run/stop" >|= fun r -> status body 200 r.status in
  Lwt_list.iter_p stop [ {|{"all": false}|}; {|{"all": false}|}; {|{"all": false}|} ] >>= fun () ->
  Lwt_unix.sleep 0.3 >>= fun () ->
  Client.ask ~port "/api/status" >>= fun r ->
  text "still on its way home" {|"stopping"|} (Yojson.Safe.to_string (member [ "run"; "state" ] (Client.json r)));
  stop {|{"all": true}|} >>= fun () ->
  Client.until first is_over >>= fun _ -> Client.leave first

(* Layers and tiles are read in threads. The runtime of OCaml 4 switches threads by SIGVTALRM: as an interruption,
   it stopped the run and ended the console. *)
let threads_interrupt_nothing () =
  let interruption = Dolphin_app.Interruption.make () in
  let signals = (Sys.sighup :: Sys.sigvtalrm :: Dolphin_processes.Ending_signals.(requests @ others)) in
  let before = List.map (fun signal -> (signal, Sys.signal signal Sys.Signal_ignore)) signals in
  List.iter (fun (signal, behaviour) -> Sys.set_signal signal behaviour) before;
  let restore () = List.iter (fun (signal, behaviour) -> Sys.set_signal signal behaviour) before in
  let busy () =
    let start = Unix.gettimeofday () in
    while Unix.gettimeofday () -. start < 0.3 do ignore (Sys.opaque_identity (ref 0)) done in
  Fun.protect ~finally:restore (fun () ->
      Dolphin_app.Interruption.on_signals interruption;
      let threads = Lwt.join [ Lwt_preemptive.detach busy (); Lwt_preemptive.detach busy () ] in
      Lwt_main.run (threads >>= fun () -> Lwt_unix.sleep 0.05);
      holds "interrupted by a thread" false (Dolphin_app.Interruption.happened interruption);
      Unix.kill (Unix.getpid ()) Sys.sigusr1;
      Lwt_main.run (Lwt_unix.sleep 0.05);
      holds "interrupted by SIGUSR1" true (Dolphin_app.Interruption.happened interruption))

(* {1 Work beside the run} *)

let checked ?(headers = []) ?(path = "short.dol") port =
  Client.ask ~headers ~body:(Printf.sprintf {|{"path": "%s"}|} path) ~port "/api/check"

(* A worker that does nothing any more: to the console, one that computes for long. *)
let hang pid = Unix.kill pid Sys.sigstop

(* The only worker there is. *)
let worker console =
  checked (Console.port console) >|= fun r ->
  status "warmed up" 200 r.status;
  match Console.workers console with [ pid ] -> pid | pids -> Alcotest.failf "%d workers" (List.length pids)

let begin_mission port =
  Client.ask ~body:{|{"program": "mission.dol", "answers": ["1"], "speed": 10}|} ~port "/api/run" >|= fun r ->
  status "begun" 200 r.status

let stop_in_time port =
  let before = Unix.gettimeofday () in
  Client.ask ~body:"{}" ~port "/api/run/stop" >|= fun r ->
  status "stopped" 200 r.status;
  holds "before the other request ends" true (Unix.gettimeofday () -. before < 5.)

(* 4,000 constants took 4 s and more, nine times as long as 2,000. *)
let seconds_of pid =
  let stat = Result.get_ok (Dolphin_app.Text_file.read (Printf.sprintf "/proc/%d/stat" pid)) in
  let after = String.index stat ')' + 2 in
  let fields = String.split_on_char ' ' (String.sub stat after (String.length stat - after)) in
  (* User and system time, in hundredths. *)
  (float_of_string (List.nth fields 11) +. float_of_string (List.nth fields 12)) /. 100.

let many_constants _ console =
  let port = Console.port console in
  let program = String.concat "" (List.init 4_000 (fun i -> Printf.sprintf "x%d = %d\\n" i i)) in
  let wrong = String.concat "" (List.init 4_000 (fun i -> Printf.sprintf "message y%d\\n" i)) in
  let check what program =
    worker console >>= fun pid ->
    let before = seconds_of pid in
    Client.ask ~body:(Printf.sprintf {|{"path": "short.dol", "text": "%s"}|} program) ~port "/api/check" >|= fun r ->
    status what 200 r.status;
    let taken = seconds_of pid -. before in
    holds (Printf.sprintf "%s: %.2f s" what taken) true (taken > 0. && taken < 1.5) in
  check "constants" program >>= fun () -> check "faults" wrong

(* A request that takes long: Stop does not wait for it, nor do requests of others; killed, it is refused, and the next
   one is not. *)
let worker_killed _ console =
  let port = Console.port console in
  worker console >>= fun pid ->
  hang pid;
  let long = checked port in
  begin_mission port >>= fun () ->
  stop_in_time port >>= fun () ->
  checked ~headers:[ ("X-Dolphin-Client", "other") ] port >>= fun r ->
  status "another request" 200 r.status;
  holds "the long one goes on" true (Lwt.is_sleeping long);
  Unix.kill pid Sys.sigkill;
  long >>= fun r ->
  refused "the worker has died" (503, "worker-died") r;
  checked port >|= fun r -> status "the next request" 200 r.status

let worker_too_slow _ console =
  let port = Console.port console in
  worker console >>= fun pid ->
  hang pid;
  checked port >>= fun r ->
  refused "too long" (503, "too-long") r;
  holds "killed" false (List.mem pid (Console.workers console));
  checked port >|= fun r -> status "the next request" 200 r.status

let little_memory folder console =
  let port = Console.port console in
  write (Filename.concat folder "large.dol") ("// " ^ String.make 40_000_000 'x');
  checked ~path:"large.dol" port >>= fun r ->
  holds (Printf.sprintf "no memory: %d %s" r.status r.body) true
    (r.status = 503 && List.mem (code r) [ "too-large"; "worker-died" ]);
  checked port >|= fun r -> status "the next request" 200 r.status

(* The console does not hold a reply that is larger than its bound; the worker that sends it ends. *)
let large_reply folder console =
  let port = Console.port console in
  worker console >>= fun pid ->
  write (Filename.concat folder "large.dol") (String.make 20_000 '\n');
  Client.ask ~port "/api/file?path=large.dol" >>= fun r ->
  refused "too large" (503, "too-large") r;
  holds "killed" false (List.mem pid (Console.workers console));
  checked port >|= fun r -> status "the next request" 200 r.status

(* A client has two workers at once, and ten requests that wait. *)
let requests_of_one_client _ console =
  let port = Console.port console in
  worker console >>= fun pid ->
  hang pid;
  let ask client = checked ~headers:[ ("X-Dolphin-Client", client) ] port in
  let first = ask "greedy" in
  Lwt_unix.sleep 0.2 >>= fun () ->
  Lwt_list.map_s
    (fun _ -> ask "greedy" >|= fun r -> r.Client.status) (List.init 5 Fun.id) >>= fun others ->
  Alcotest.(check (list int)) "by the second worker" [ 200; 200; 200; 200; 200 ] others;
  List.iter (fun pid -> try hang pid with Unix.Unix_error _ -> ()) (Console.workers console);
  let all = List.init 30 (fun _ -> ask "greedy") in
  Lwt.nchoose all >>= fun refused_at_once ->
  List.iter (refused "too many of one client" (503, "too-many")) refused_at_once;
  ask "other" >>= fun r ->
  status "another client" 200 r.status;
  List.iter (fun pid -> Unix.kill pid Sys.sigkill) (Console.workers console);
  Lwt.join (List.map (fun reply -> reply >|= ignore) (first :: all))

(* What blocks who reads it: a pipe among the runs. *)
let pipe_among_runs _ console =
  let port = Console.port console in
  let runs = Filename.concat (Sys.getenv "XDG_STATE_HOME") "dolphin/runs" in
  begin_mission port >>= fun () ->
  Unix.mkfifo (Filename.concat runs "pipe.run") 0o600;
  let listed = Client.ask ~port "/api/runs" in
  stop_in_time port >>= fun () ->
  listed >|= refused "the list" (503, "too-long")

(* A long journal begins at once; a reader that leaves takes its worker with it. *)
let long_journal folder console =
  let port = Console.port console in
  begin_mission port >>= fun () ->
  stop_in_time port >>= fun () ->
  let runs = Filename.concat (Sys.getenv "XDG_STATE_HOME") "dolphin/runs" in
  let journal = Filename.concat runs (Sys.readdir runs).(0) in
  let lines = String.split_on_char '\n' (Result.get_ok (Dolphin_app.Text_file.read journal)) in
  let vehicle = List.find (has_text {|"kind":"vehicle"|}) lines in
  let channel = open_out_bin (Filename.concat folder "long.run") in
  output_string channel (List.hd lines ^ "\n");
  for _ = 1 to 60_000 do output_string channel (vehicle ^ "\n") done;
  close_out channel;
  Client.events ~port "/api/replay?path=long.run" >>= fun reader ->
  Client.until reader (fun m -> m.event = "journal") >>= fun _ ->
  begin_mission port >>= fun () ->
  stop_in_time port >>= fun () ->
  status "a worker for requests, one for the replay" 2 (List.length (Console.workers console));
  Client.leave reader >>= fun () ->
  let rec gone n =
    if List.length (Console.workers console) < 2 then Lwt.return_unit
    else if n = 0 then Alcotest.fail "the worker of the replay lives"
    else Lwt_unix.sleep 0.05 >>= fun () -> gone (n - 1) in
  gone 400 >>= fun () ->
  Client.events ~port "/api/replay?path=long.run" >>= fun reader ->
  Client.until reader (fun m -> m.event = "end") >>= fun seen ->
  status "all of it" 60_001 (List.length (events "journal" seen));
  Client.leave reader

(* {1 Strangers and those who watch} *)

(* Idle connections, streams of events, requests without a token and with that for watching: the steerer does not notice
   any of them. *)
let hostile_watchers _ console =
  let port = Console.port console in
  let token role = List.nth (String.split_on_char '=' (List.assoc role (Console.links console))) 1 in
  let by role = ("Authorization", "Bearer " ^ token role) in
  let steers = by "steers" and watches = by "watches" in
  Lwt_list.map_p (fun _ -> Client.connect port) (List.init 430 Fun.id) >>= fun idle ->
  let stream n = Client.events ~headers:[ watches ] ~port (Printf.sprintf "/api/events?client=watcher-%d" (n / 3)) in
  Lwt_list.map_s stream (List.init 99 Fun.id) >>= fun streams ->
  let flood header =
    let request = Printf.sprintf "GET /api/status HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n%s\r\n" port header in
    Client.raw ~no_more:true ~port (String.concat "" (List.init 3_000 (fun _ -> request))) in
  let floods = [ flood ""; flood "Origin: http://evil.example\r\n"; flood (fst watches ^ ": " ^ snd watches ^ "\r\n") ] in
  let more = Lwt_list.map_p (fun _ -> Client.connect port) (List.init 200 Fun.id) in
  let ask ?body path = Client.ask ?body ~headers:[ steers ] ~port path in
  let rec often n =
    if n = 0 then Lwt.return_unit
    else ask "/api/status" >>= fun r -> status "status" 200 r.status; often (n - 1) in
  often 20 >>= fun () ->
  Client.events ~headers:[ steers ] ~port "/api/events?client=boss" >>= fun boss ->
  Client.until boss (fun m -> m.event = "status") >>= fun _ ->
  ask ~body:{|{"program": "mission.dol", "answers": ["1"], "speed": 10}|} "/api/run" >>= fun r ->
  status "begun" 200 r.status;
  ask ~body:"{}" "/api/run/stop" >>= fun r ->
  status "stopped" 200 r.status;
  Client.until boss is_over >>= fun _ ->
  Lwt.join (List.map (fun reply -> reply >|= ignore) floods) >>= fun () ->
  more >>= fun more ->
  Lwt_list.iter_p (fun s -> Lwt_unix.close s) (idle @ more) >>= fun () -> Lwt_list.iter_s Client.leave (boss :: streams)

(* One client looks on six times at most. *)
let streams_of_one_client _ port =
  Lwt_list.map_s (fun _ -> Client.watch ~port "one") (List.init 6 Fun.id) >>= fun streams ->
  Client.ask ~port "/api/events?client=one" >>= fun r ->
  refused "a seventh stream" (503, "too-many") r;
  Client.watch ~port "other" >>= fun other ->
  Client.until other (fun m -> m.event = "status") >>= fun _ -> Lwt_list.iter_s Client.leave (other :: streams)

(* docs/openapi.json describes all requests, and no others. *)
let described () =
  let paths = Yojson.Safe.Util.(to_assoc (member "paths" (Yojson.Safe.from_file "../../docs/openapi.json"))) in
  let of_path (path, methods) =
    List.map (fun (verb, _) -> (String.uppercase_ascii verb, path)) (Yojson.Safe.Util.to_assoc methods) in
  let sorted = List.sort compare in
  Alcotest.(check (list (pair string string))) "requests" (sorted Api.routes) (sorted (List.concat_map of_path paths))

let with_limits change f = served (fun folder -> { (settings folder) with workers = change Worker_pool.limits }) f

(* The console starts this program for its workers. *)
let () =
  match Sys.argv with
  | [| _; "console-worker"; "--megabytes"; megabytes |] -> Worker.main ~megabytes:(int_of_string megabytes); exit 0
  | _ -> ()

let manned folder = { (settings folder) with listen = Some Unix.inet_addr_loopback; operators = bridge }

let () =
  let slow name f = Alcotest.test_case name `Quick f in
  Alcotest.run "console"
    [ ("http",
       [ slow "heads" heads; slow "sizes" sizes; slow "patience" patience; slow "connections" connections; slow "rate" rate; slow "large replies" large_replies;
         slow "TLS" tls; slow "handshakes" handshakes ]);
      ("helm",
       [ slow "who has it" the_helm; slow "Stop without it" (console stop_without_helm);
         slow "Stop pressed twice" (console stop_twice) ]);
      ("safe",
       [ slow "who may ask" (console who_may_ask);
         slow "with tokens"
           (served (fun folder -> { (settings folder) with listen = Some Unix.inet_addr_loopback }) with_tokens); slow "no escape from the folder" (console no_escape);
         slow "malformed requests" (console malformed); slow "tiles" tiles; slow "described" described;
         slow "hostile watchers"
           (served (fun folder -> { (settings folder) with listen = Some Unix.inet_addr_loopback }) hostile_watchers);
         slow "the operators' file" operators_file;
         slow "named operators"
           (served (fun folder ->
                { (settings folder) with listen = Some Unix.inet_addr_loopback; operators = crew }) named_operators);
         slow "another program"
           (served (fun folder ->
                { (settings folder) with listen = Some Unix.inet_addr_loopback; operators = crew }) replaced);
         slow "questions for some operators" addressed; slow "headers of proxies" proxy_header;
         slow "questions for the pilot" (served manned questions_for_some); slow "shut out" (served manned shut_out);
         slow "behind a proxy"
           (served (fun folder -> { (settings folder) with operators = bridge; proxy_header = Some "x-forwarded-user" })
              behind_a_proxy);
         slow "streams of one client" (console streams_of_one_client) ]);
      ("workers",
       [ slow "killed" (with_limits Fun.id worker_killed);
         slow "too slow" (with_limits (fun l -> { l with seconds = 1. }) worker_too_slow);
         slow "little memory" (with_limits (fun l -> { l with megabytes = 150 }) little_memory);
         slow "a large reply" (with_limits (fun l -> { l with reply = 10_000 }) large_reply);
         slow "requests of one client" (with_limits Fun.id requests_of_one_client);
         slow "a pipe among the runs" (with_limits (fun l -> { l with seconds = 2. }) pipe_among_runs);
         slow "a long journal" (with_limits Fun.id long_journal) ]);
      ("page",
       [ slow "compressed and cached" (served (fun folder -> { (settings folder) with page = page_of folder }) page_is_cached) ]);
      ("files", [ slow "saving" (console saving); slow "texts under way" (console texts);
                  slow "many constants" (with_limits Fun.id many_constants) ]);
      ("runs",
       [ slow "threads" threads_interrupt_nothing; slow "a run" (console a_run); slow "journals of the folder" (console journals); slow "answers and posts" (console answers_and_posts);
         slow "what is asked" (console what_is_asked);
         slow "open questions" (console open_questions); slow "on the map" (console on_the_map); slow "drawn" (console drawn);
         slow "stopped" (console stopped); slow "outlook" (console outlook); slow "stuck" (console stuck);
         slow "interrupted is not stuck" (console interrupted_is_not_stuck); slow "faults" (console faults) ]) ]
