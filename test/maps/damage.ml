open Dolphin_maps
open Shown

(* {1 Archives} *)

let checksum text = Int32.to_int (Zlib.update_crc_string 0l text 0 (String.length text))

(* [pack text] is how a file is packed, 0 for not at all, and its bytes then. [count] is written in place of the number
   of files. With [is_zip64] the numbers of the list stand in extra fields, and those of the end in a record of its
   own. *)
let archive ?(check = checksum) ?(pack = fun text -> (0, text)) ?count ?(is_zip64 = false) files =
  let b = Buffer.create 1000 and directory = Buffer.create 1000 in
  let u16 b n = Buffer.add_uint16_le b n and u32 b n = Buffer.add_int32_le b (Int32.of_int n) in
  let u64 b n = Buffer.add_int64_le b (Int64.of_int n) in
  let unless_zip64 n = if is_zip64 then 0xFFFF_FFFF else n in
  let common b text (how, packed) =
    List.iter (u16 b) [ 20; 0; how; 0; 0 ];
    List.iter (u32 b) [ check text; unless_zip64 (String.length packed); unless_zip64 (String.length text) ]
  in
  let add (name, text) =
    let start = Buffer.length b and packed = pack text in
    u32 b 0x04034b50;
    common b text packed;
    List.iter (u16 b) [ String.length name; 0 ];
    Buffer.add_string b (name ^ snd packed);
    u32 directory 0x02014b50;
    u16 directory 20;
    common directory text packed;
    List.iter (u16 directory) [ String.length name; (if is_zip64 then 32 else 0); 0; 0; 0 ];
    List.iter (u32 directory) [ 0; unless_zip64 start ];
    Buffer.add_string directory name;
    if is_zip64 then begin
      List.iter (u16 directory) [ 7; 0; 1; 24 ];
      List.iter (u64 directory) [ String.length text; String.length (snd packed); start ]
    end
  in
  List.iter add files;
  let start = Buffer.length b in
  Buffer.add_buffer b directory;
  let count = Option.value count ~default:(List.length files) and listed = Buffer.length b in
  if is_zip64 then begin
    u32 b 0x06064b50;
    u64 b 44;
    List.iter (u16 b) [ 45; 45 ];
    List.iter (u32 b) [ 0; 0 ];
    List.iter (u64 b) [ count; count; Buffer.length directory; start ];
    u32 b 0x07064b50;
    u32 b 0;
    u64 b listed;
    u32 b 1
  end;
  u32 b 0x06054b50;
  let count = if is_zip64 then 0xFFFF else count in
  List.iter (u16 b) [ 0; 0; count; count ];
  List.iter (u32 b) [ Buffer.length directory; unless_zip64 start ];
  u16 b 0;
  Buffer.contents b

let place name = Printf.sprintf "<Placemark><name>%s</name><Point><coordinates>-8,41</coordinates></Point></Placemark>" name
let link href = Printf.sprintf "<NetworkLink><Link><href>%s</href></Link></NetworkLink>" href
let kml inside = "<kml>" ^ inside ^ "</kml>"

let archives () =
  let at = ": (41.000000, -8.000000)" in
  let read files = shown "m.kmz" (archive files) in
  check "one" ("a" ^ at) (read [ ("a.kml", kml (place "a")) ]);
  check "a resource fork" ("a" ^ at)
    (read [ ("__MACOSX/._doc.kml", "\000\005"); ("doc.kml", kml (place "a")); ("._a.kml", "\000") ]);
  check "doc.kml is the map" ("a" ^ at ^ "; note: b.kml: doc.kml does not link to this file, and left out")
    (read [ ("b.kml", kml (place "b")); ("doc.kml", kml (place "a")) ]);
  check "links are followed, each once"
    ("a" ^ at ^ "; b" ^ at ^ "; note: files/b.kml, line 1: the link to '../doc.kml' is not followed, and left out")
    (read
       [ ("doc.kml", kml (place "a" ^ link "files/b.kml")); ("files/b.kml", kml (place "b" ^ link "../doc.kml")) ]);
  let links ?(from = "doc.kml") href target =
    let note = Printf.sprintf "; note: %s, line 1: the link to '%s' is not followed, and left out" from href in
    let left = Printf.sprintf "; note: %s: %s does not link to this file, and left out" target from in
    match read [ (from, kml (place "a" ^ link href)); (target, kml (place "b")) ] with
    | text when text = "a" ^ at ^ "; b" ^ at -> true
    | text -> check href ("a" ^ at ^ note ^ left) text; false
  in
  let follows ?from href target = Alcotest.(check bool) href true (links ?from href target) in
  let refuses ?from href target = Alcotest.(check bool) href false (links ?from href target) in
  follows "maps/no%20fly.kml" "maps/no fly.kml";
  follows "n%C3%A3o%2e%6bml" "n\xc3\xa3o.kml";
  follows "maps/no fly.kml" "maps/no fly.kml";
  follows "b%2520c.kml" "b%20c.kml";
  follows "b%20c.kml" "b%20c.kml";
  follows "100%.kml" "100%.kml";
  follows "b.kml#region" "b.kml";
  follows "b%23c.kml" "b#c.kml";
  follows "b#c.kml" "b#c.kml";
  follows "./x/../b.kml" "b.kml";
  follows "x%2F..%2fb.kml" "x%2F..%2fb.kml";
  follows ~from:"maps/doc.kml" "%2e%2E/b.kml" "b.kml";
  List.iter
    (fun href -> refuses href "b.kml")
    [ "../b.kml"; "%2e%2e/b.kml"; "x/../../b.kml"; "/b.kml"; "//b.kml"; "//host/b.kml"; "file:b.kml"; "x%2F..%2Fb.kml";
      "b.kml%00"; "b.kml?x"; "b%2"; "http://example.org/b.kml" ];
  refuses "http://example.org/b.kml" "http:/example.org/b.kml";
  refuses "c%2Fb.kml" "c/b.kml";
  let two = [ ("doc.kml", kml (place "a" ^ link "b.kml")); ("b.kml", kml (place "b")) ] in
  check "ZIP64" ("a" ^ at ^ "; b" ^ at) (shown "m.kmz" (archive ~is_zip64:true two));
  List.iter
    (fun is_zip64 ->
       List.iter
         (fun count ->
            check "another number of files" "wrong: this ZIP archive is broken"
              (shown "m.kmz" (archive ~count ~is_zip64 two)))
         [ 1; 3 ])
    [ false; true ];
  check "two files of one name" "wrong: this archive has two files 'doc.kml'"
    (read [ ("doc.kml", kml (place "a")); ("doc.kml", kml (place "b")) ]);
  let file i = Printf.sprintf "%d.kml" i in
  let links = kml (place "a" ^ String.concat "" (List.init 20_000 (fun i -> link (file i)))) in
  let before = Sys.time () in
  check "many links" ("a" ^ at)
    (read (("doc.kml", links) :: List.init 20_000 (fun i -> (file i, kml ""))));
  Alcotest.(check bool) "soon" true (Sys.time () -. before < 5.);
  check "another checksum" "wrong: 'doc.kml' in this archive is damaged: its checksum is another"
    (shown "m.kmz" (archive ~check:(fun _ -> 7) [ ("doc.kml", kml (place "a")) ]))

(* An archive by another program, cut or changed at any byte, ends at once: as an error or as the same map. *)
let damaged_archives is_zip64 =
  let whole = archive ~is_zip64 [ ("doc.kml", kml (place "a")) ] in
  let good = shown "m.kmz" whole in
  let gen = QCheck2.Gen.(pair (int_bound (String.length whole - 1)) (int_bound 255)) in
  Test_support.Property.case ~count:2000
    (if is_zip64 then "a byte of a ZIP64 archive is changed" else "a byte of an archive is changed") gen
    ~print:(fun (i, c) -> Printf.sprintf "%d is %d" i c)
    (fun (i, c) ->
       let text = String.mapi (fun j old -> if i = j then Char.chr c else old) whole in
       let found = shown "m.kmz" text in
       found = good || String.starts_with ~prefix:"wrong: " found
       || (* its name is not part of the checked content *) String.starts_with ~prefix:"note: " found)

let deflated text =
  let b = Buffer.create 100 and read = ref 0 in
  let refill bytes =
    let n = Int.min (Bytes.length bytes) (String.length text - !read) in
    Bytes.blit_string text !read bytes 0 n;
    read := !read + n;
    n
  in
  Zlib.compress ~header:false refill (fun bytes n -> Buffer.add_subbytes b bytes 0 n);
  Buffer.contents b

(* A stream of deflate that is cut anywhere. *)
let cut_streams () =
  let text = kml (String.concat "" (List.init 50 (fun i -> place (string_of_int i)))) in
  let stream = deflated text in
  let read length =
    let pack _ = (8, String.sub stream 0 length) in
    Map_file.read ~path:"m.kmz" (archive ~pack [ ("doc.kml", text) ])
  in
  Alcotest.(check bool) "whole" true (Result.is_ok (read (String.length stream)));
  for length = 0 to String.length stream - 1 do
    if Result.is_ok (read length) then Alcotest.failf "cut to %d bytes, it is read" length
  done

(* {1 Damaged files} *)

let samples =
  [ ("m.geojson", collection [ feature "Polygon" (Printf.sprintf "[%s,[]]" square); feature "LineString" "[[1,2],[3,4,5]]" ]);
    ("m.kml", kml ("<Placemark><name>a</name><MultiGeometry><Polygon><outerBoundaryIs><LinearRing><coordinates>0,0 1e-3,0 \
                    .001,0.001 0,0</coordinates></LinearRing></outerBoundaryIs></Polygon></MultiGeometry></Placemark>"
                   ^ link "a.kml"));
    ("m.kmz", archive [ ("doc.kml", kml (place "a")); ("b.kml", kml (place "b")) ]);
    ("m.gpx", "<?xml version='1.0' encoding='windows-1252'?><gpx><wpt lat='1' lon='2'><ele>3</ele></wpt><trk><trkseg>\
               <trkpt lat='1' lon='2'/></trkseg></trk></gpx>");
    ("m.plan", {|{"fileType":"Plan","mission":{"plannedHomePosition":[41,-8,10],"items":[{"type":"SimpleItem","frame":3,
      "command":16,"params":[0,0,0,null,41.1,-8,30]},{"type":"ComplexItem","complexItemType":"survey","polygon":[[0,0],
      [0,0.001],[0.001,0]]}]},"geoFence":{"circles":[{"circle":{"center":[41,-8],"radius":9}}]},"rallyPoints":
      {"points":[[1,2,3]]}}|});
    ("m.nmap", "<map><features><path><id>x</id><coordinate><latitude>41N30'36.0''</latitude><longitude>8W15'0''</longitude>\
                </coordinate><shape>true</shape><translation><n>1</n><e>2</e></translation></path><QRouteElement><path>1,2;\
                3,4</path></QRouteElement></features></map>") ]

type damage = Cut | Changed of char | Inserted of string

(* Digits, brackets and quotes are changed into others more often than chance would. *)
let damage =
  let open QCheck2.Gen in
  let character = oneof [ char; oneofl [ '0'; '9'; '-'; '.'; 'e'; '"'; '['; ']'; '{'; '}'; '<'; '>'; '/'; ','; ' '; '\''; '&' ] ] in
  let inserted = oneofl [ "1e999"; "nan"; "0x29"; "[]"; "null"; "-1e308"; "\xff"; "99999999999999999999"; "<a>"; "]]>" ] in
  oneof [ return Cut; map (fun c -> Changed c) character; map (fun c -> Changed c) character;
          map (fun text -> Inserted text) inserted ]

let damaged text (share, damage) =
  let n = String.length text in
  let i = Int.min (n - 1) (int_of_float (share *. float_of_int n)) in
  let before = String.sub text 0 i and behind = String.sub text (i + 1) (n - i - 1) in
  match damage with
  | Cut -> before
  | Changed c -> before ^ String.make 1 c ^ behind
  | Inserted more -> before ^ more ^ behind

let is_fit text =
  let rec go i =
    i >= String.length text
    || (text.[i] >= ' ' && text.[i] <> '\127'
        && go (i + 1)) in
  go 0

let damaged_files =
  let open QCheck2.Gen in
  let gen = pair (oneofl samples) (list_size (int_range 1 6) (pair (float_bound_inclusive 1.) damage)) in
  let text ((_, text), damages) =
    List.fold_left (fun text d -> if text = "" then text else damaged text d) text damages in
  Test_support.Property.case ~count:5000 "damaged files" gen ~print:(fun x -> fst (fst x) ^ ": " ^ String.escaped (text x))
    (fun x ->
       let path = fst (fst x) in
       (match Map_file.outlines ~path (text x) with
        | Ok outlines -> List.for_all (fun (name, _) -> is_fit name) outlines
        | Error why -> is_fit why)
       &&
       match Map_file.read ~path (text x) with
       | Ok { things; notes } ->
         let names = List.map fst things in
         List.length (List.sort_uniq String.compare names) = List.length names
         && List.for_all is_fit names && List.for_all is_fit notes
         && List.for_all (fun (_, thing) -> match thing with Ok _ -> true | Error why -> is_fit why) things
       | Error why -> is_fit why)

let cases =
  [ case "archives" archives;
    case "streams cut short" cut_streams;
    damaged_archives false;
    damaged_archives true;
    damaged_files ]
