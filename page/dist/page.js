function ca(n,e){return n!==null&&typeof n=="object"&&"$typeName"in n&&typeof n.$typeName=="string"?e===void 0?!0:e.typeName===n.$typeName:!1}var K;(function(n){n[n.DOUBLE=1]="DOUBLE",n[n.FLOAT=2]="FLOAT",n[n.INT64=3]="INT64",n[n.UINT64=4]="UINT64",n[n.INT32=5]="INT32",n[n.FIXED64=6]="FIXED64",n[n.FIXED32=7]="FIXED32",n[n.BOOL=8]="BOOL",n[n.STRING=9]="STRING",n[n.BYTES=12]="BYTES",n[n.UINT32=13]="UINT32",n[n.SFIXED32=15]="SFIXED32",n[n.SFIXED64=16]="SFIXED64",n[n.SINT32=17]="SINT32",n[n.SINT64=18]="SINT64"})(K||(K={}));function Hp(){let n=this.buf,e=this.pos,t=0,i=0;for(let r=0;r<28;r+=7){let o=n[e++];if(t|=(o&127)<<r,(o&128)==0){this.pos=e,this.assertBounds(),this.varint64Lo=t,this.varint64Hi=i;return}}let s=n[e++];if(t|=(s&15)<<28,i=(s&112)>>4,(s&128)==0){this.pos=e,this.assertBounds(),this.varint64Lo=t,this.varint64Hi=i;return}for(let r=3;r<=31;r+=7){let o=n[e++];if(i|=(o&127)<<r,(o&128)==0){this.pos=e,this.assertBounds(),this.varint64Lo=t,this.varint64Hi=i;return}}throw new Error("invalid varint")}var Ll=4294967296;function Uh(n){let e=n[0]==="-";e&&(n=n.slice(1));let t=1e6,i=0,s=0;function r(o,a){let c=Number(n.slice(o,a));s*=t,i=i*t+c,i>=Ll&&(s=s+(i/Ll|0),i=i%Ll)}return r(-24,-18),r(-18,-12),r(-12,-6),r(-6),e?Xp(i,s):Fh(i,s)}function Wp(n,e){let t=Fh(n,e),i=t.hi&2147483648;i&&(t=Xp(t.lo,t.hi));let s=Oh(t.lo,t.hi);return i?"-"+s:s}function Oh(n,e){if({lo:n,hi:e}=$x(n,e),e<=2097151)return String(Ll*e+n);let t=n&16777215,i=(n>>>24|e<<8)&16777215,s=e>>16&65535,r=t+i*6777216+s*6710656,o=i+s*8147497,a=s*2,c=1e7;return r>=c&&(o+=Math.floor(r/c),r%=c),o>=c&&(a+=Math.floor(o/c),o%=c),a.toString()+Vp(o)+Vp(r)}function $x(n,e){return{lo:n>>>0,hi:e>>>0}}function Fh(n,e){return{lo:n|0,hi:e|0}}function Xp(n,e){return e=~e,n?n=~n+1:e+=1,Fh(n,e)}var Vp=n=>{let e=String(n);return"0000000".slice(e.length)+e};function Yp(n,e){if(n>>>0<128){e.push(n);return}if(n>=0){for(;n>127;)e.push(n&127|128),n=n>>>7;e.push(n)}else{for(let t=0;t<9;t++)e.push(n&127|128),n=n>>7;e.push(1)}}function Kp(){let n=this.buf[this.pos++];if((n&128)===0)return this.assertBounds(),n;let e=n&127;if(n=this.buf[this.pos++],e|=(n&127)<<7,(n&128)===0)return this.assertBounds(),e;if(n=this.buf[this.pos++],e|=(n&127)<<14,(n&128)===0)return this.assertBounds(),e;if(n=this.buf[this.pos++],e|=(n&127)<<21,(n&128)===0)return this.assertBounds(),e;n=this.buf[this.pos++],e|=(n&15)<<28;for(let t=5;(n&128)!==0&&t<10;t++)n=this.buf[this.pos++];if((n&128)!==0)throw new Error("invalid varint");return this.assertBounds(),e>>>0}var wt=Jx();function Jx(){let n=new DataView(new ArrayBuffer(8));if(typeof BigInt=="function"&&typeof n.getBigInt64=="function"&&typeof n.getBigUint64=="function"&&typeof n.setBigInt64=="function"&&typeof n.setBigUint64=="function"&&(!!globalThis.Deno||!!globalThis.Bun||typeof process!="object"||typeof process.env!="object"||process.env.BUF_BIGINT_DISABLE!=="1")){let t=BigInt("-9223372036854775808"),i=BigInt("9223372036854775807"),s=BigInt("0"),r=BigInt("18446744073709551615");return{zero:BigInt(0),supported:!0,parse(o){let a=typeof o=="bigint"?o:BigInt(o);if(a>i||a<t)throw new Error(`invalid int64: ${o}`);return a},uParse(o){let a=typeof o=="bigint"?o:BigInt(o);if(a>r||a<s)throw new Error(`invalid uint64: ${o}`);return a},enc(o){return n.setBigInt64(0,this.parse(o),!0),{lo:n.getInt32(0,!0),hi:n.getInt32(4,!0)}},uEnc(o){return n.setBigInt64(0,this.uParse(o),!0),{lo:n.getInt32(0,!0),hi:n.getInt32(4,!0)}},dec(o,a){return n.setInt32(0,o,!0),n.setInt32(4,a,!0),n.getBigInt64(0,!0)},uDec(o,a){return n.setInt32(0,o,!0),n.setInt32(4,a,!0),n.getBigUint64(0,!0)}}}return{zero:"0",supported:!1,parse(t){return typeof t!="string"&&(t=t.toString()),Zp(t),t},uParse(t){return typeof t!="string"&&(t=t.toString()),qp(t),t},enc(t){return typeof t!="string"&&(t=t.toString()),Zp(t),Uh(t)},uEnc(t){return typeof t!="string"&&(t=t.toString()),qp(t),Uh(t)},dec(t,i){return Wp(t,i)},uDec(t,i){return Oh(t,i)}}}function Zp(n){if(!/^-?[0-9]+$/.test(n))throw new Error("invalid int64: "+n)}function qp(n){if(!/^[0-9]+$/.test(n))throw new Error("invalid uint64: "+n)}function Zr(n,e,t){if(e===t)return!0;if(n==K.BYTES){if(!(e instanceof Uint8Array)||!(t instanceof Uint8Array)||e.length!==t.length)return!1;for(let i=0;i<e.length;i++)if(e[i]!==t[i])return!1;return!0}switch(n){case K.UINT64:case K.FIXED64:case K.INT64:case K.SFIXED64:case K.SINT64:return e==t}return!1}function Pi(n,e){switch(n){case K.STRING:return"";case K.BOOL:return!1;case K.DOUBLE:case K.FLOAT:return 0;case K.INT64:case K.UINT64:case K.SFIXED64:case K.FIXED64:case K.SINT64:return e?"0":wt.zero;case K.BYTES:return new Uint8Array(0);default:return 0}}function $p(n,e){switch(n){case K.BOOL:return e===!1;case K.STRING:return e==="";case K.BYTES:return e instanceof Uint8Array&&!e.byteLength;case K.DOUBLE:case K.FLOAT:return Object.is(e,0);default:return e==0}}var Jp=2,ai=Symbol.for("reflect unsafe local");function jp(n,e){let t=n[e.localName].case;return t===void 0?t:e.fields.find(i=>i.localName===t)}function Qp(n,e){let t=e.localName;if(e.oneof)return n[e.oneof.localName].case===t;if(e.presence!=Jp)return n[t]!==void 0&&Object.prototype.hasOwnProperty.call(n,t);switch(e.fieldKind){case"list":return n[t].length>0;case"map":return Object.keys(n[t]).length>0;case"scalar":return!$p(e.scalar,n[t]);case"enum":return n[t]!==e.enum.values[0].number}throw new Error("message field with implicit presence")}function hr(n,e){return Object.prototype.hasOwnProperty.call(n,e)&&n[e]!==void 0}function em(n,e){if(e.oneof){let t=n[e.oneof.localName];return t.case===e.localName?t.value:void 0}return n[e.localName]}function tm(n,e,t){e.oneof?n[e.oneof.localName]={case:e.localName,value:t}:n[e.localName]=t}function ms(n,e,t){e==="__proto__"?Object.defineProperty(n,"__proto__",{value:t,writable:!0,enumerable:!0,configurable:!0}):n[e]=t}function nm(n,e){return Object.prototype.hasOwnProperty.call(n,e)?n[e]:void 0}function im(n,e){let t=e.localName;if(e.oneof){let i=e.oneof.localName;n[i].case===t&&(n[i]={case:void 0})}else if(e.presence!=Jp)delete n[t];else switch(e.fieldKind){case"map":n[t]={};break;case"list":n[t]=[];break;case"enum":n[t]=e.enum.values[0].number;break;case"scalar":n[t]=Pi(e.scalar,e.longAsString);break}}function Ni(n){return n!==null&&typeof n=="object"&&!Array.isArray(n)}function ua(n,e){var t,i,s,r;if(Ni(n)&&ai in n&&"add"in n&&"field"in n&&typeof n.field=="function"){if(e!==void 0){let o=e,a=n.field();return o.listKind==a.listKind&&o.scalar===a.scalar&&((t=o.message)===null||t===void 0?void 0:t.typeName)===((i=a.message)===null||i===void 0?void 0:i.typeName)&&((s=o.enum)===null||s===void 0?void 0:s.typeName)===((r=a.enum)===null||r===void 0?void 0:r.typeName)}return!0}return!1}function ha(n,e){var t,i,s,r;if(Ni(n)&&ai in n&&"has"in n&&"field"in n&&typeof n.field=="function"){if(e!==void 0){let o=e,a=n.field();return o.mapKey===a.mapKey&&o.mapKind==a.mapKind&&o.scalar===a.scalar&&((t=o.message)===null||t===void 0?void 0:t.typeName)===((i=a.message)===null||i===void 0?void 0:i.typeName)&&((s=o.enum)===null||s===void 0?void 0:s.typeName)===((r=a.enum)===null||r===void 0?void 0:r.typeName)}return!0}return!1}function fa(n,e){return Ni(n)&&ai in n&&"desc"in n&&Ni(n.desc)&&n.desc.kind==="message"&&(e===void 0||n.desc.typeName==e.typeName)}function sm(n){return rm(n.$typeName)}function ks(n){let e=n.fields[0];return rm(n.typeName)&&e!==void 0&&e.fieldKind=="scalar"&&e.name=="value"&&e.number==1}var jx=new Set(["google.protobuf.DoubleValue","google.protobuf.FloatValue","google.protobuf.Int64Value","google.protobuf.UInt64Value","google.protobuf.Int32Value","google.protobuf.UInt32Value","google.protobuf.BoolValue","google.protobuf.StringValue","google.protobuf.BytesValue"]);function rm(n){return jx.has(n)}var Qx=999,ev=998,am=2;function yi(n,e){return ca(e,n)?e:lm(n)(e)}var om=new WeakMap;function lm(n){let e=om.get(n);return e===void 0&&(e=tv(n),om.set(n,e)),e}var Bh=0,cm=1,um=2,hm=3;function tv(n){let e=n.typeName,{properties:t,prototype:i}=nv(n);return s=>{let r;i!==void 0?(r=Object.create(i),r.$typeName=e):r={$typeName:e};for(let o=0;o<t.length;o++){let a=t[o],c=a.name,l=s?.[c];switch(a.kind){case Bh:l!=null?r[c]=a.convert!==void 0?a.convert(l):l:a.constant!==void 0&&(r[c]=a.constant);break;case cm:r[c]=a.convert!==void 0&&Array.isArray(l)?l.map(a.convert):l??[];break;case um:if(a.convert===void 0||!Ni(l))r[c]=l??{};else{let u={},h=Object.keys(l);for(let f=0;f<h.length;f++)ms(u,h[f],a.convert(l[h[f]]));r[c]=u}break;case hm:{let u=l;if(u?.case!=null){let h=a.convert.get(u.case);if(h!==void 0){r[c]={case:u.case,value:h(u.value)};break}}r[c]={case:void 0};break}}}return r}}function nv(n){var e,t;let i=[],s={},r=sv(n);for(let o of n.members){let a=o.localName;if(o.kind=="oneof"){i.push({name:a,kind:hm,constant:void 0,convert:iv(o)});continue}switch(o.fieldKind){case"message":{i.push({name:a,kind:Bh,constant:void 0,convert:Dl(o)});break}case"list":{i.push({name:a,kind:cm,constant:void 0,convert:o.listKind=="message"?(e=Dl(o))!==null&&e!==void 0?e:(c=>c):o.scalar==K.BYTES?da:void 0});break}case"map":{i.push({name:a,kind:um,constant:void 0,convert:o.mapKind=="message"?(t=Dl(o))!==null&&t!==void 0?t:(c=>c):o.scalar==K.BYTES?da:void 0});break}default:{let c=rv(o);i.push({name:a,kind:Bh,constant:o.presence==am?c:void 0,convert:o.fieldKind=="scalar"&&o.scalar==K.BYTES?da:void 0}),r&&(s[a]=c);break}}}return{properties:i,prototype:r?s:void 0}}function iv(n){let e=new Map;for(let t of n.fields){let i;t.fieldKind=="message"?i=Dl(t):t.fieldKind=="scalar"&&t.scalar==K.BYTES&&(i=da),e.set(t.localName,i??(s=>s))}return e}function Dl(n){if(n.fieldKind=="message"&&!n.oneof&&ks(n.message))return n.message.fields[0].scalar==K.BYTES?da:void 0;if(n.message.typeName=="google.protobuf.Struct"&&n.parent.typeName!=="google.protobuf.Value")return;let e=n.message,t;return i=>!Ni(i)||ca(i,e)?i:(t??(t=lm(e)),t(i))}function da(n){return Array.isArray(n)?new Uint8Array(n):n}function sv(n){switch(n.file.edition){case Qx:return!1;case ev:return!0;default:return n.fields.some(e=>e.presence!=am&&e.fieldKind!="message"&&!e.oneof)}}function rv(n){let e=n.getDefaultValue();return e!==void 0?n.fieldKind=="scalar"&&n.longAsString?e.toString():e:n.fieldKind=="scalar"?Pi(n.scalar,n.longAsString):n.enum.values[0].number}var xi=class extends Error{constructor(e,t,i="FieldValueInvalidError"){super(t),this.name=i,this.field=()=>e}};var kh;function ov(n){var e;kh=Object.assign(Object.assign({},n),{encodeUtf8Into:(e=n.encodeUtf8Into)!==null&&e!==void 0?e:Gh(n.encodeUtf8.bind(n))})}function pa(){if(!kh){let n=globalThis;if(!n.TextEncoder||!n.TextDecoder)throw new Error("encoding API missing: install TextEncoder and TextDecoder on globalThis");let e=new n.TextEncoder,t=new n.TextDecoder("utf-8",{ignoreBOM:!0}),i,s={encodeUtf8(o){return e.encode(o)},decodeUtf8(o,a){return a?(i||(i=new n.TextDecoder("utf-8",{fatal:!0,ignoreBOM:!0})),i.decode(o)):t.decode(o)},checkUtf8(o){try{return encodeURIComponent(o),!0}catch{return!1}}};e.encodeInto&&(s.encodeUtf8Into=e.encodeInto.bind(e));let r=String.prototype.isWellFormed;r&&(s.checkUtf8=o=>r.call(o)),ov(s)}return kh}function Gh(n){return(e,t)=>{let i=n(e);return t.set(i),{written:i.byteLength}}}var Ft;(function(n){n[n.Varint=0]="Varint",n[n.Bit64=1]="Bit64",n[n.LengthDelimited=2]="LengthDelimited",n[n.StartGroup=3]="StartGroup",n[n.EndGroup=4]="EndGroup",n[n.Bit32=5]="Bit32"})(Ft||(Ft={}));var Hh=4294967295,Wh=2147483647,Xh=-2147483648,ga=class{constructor(e){this.stackPos=[],this.encodeUtf8Into=e?Gh(e):pa().encodeUtf8Into,this.buffer=dm,this.viewCache=lv,this.pos=0}ensureCapacity(e){let t=this.pos+e;if(t>this.buffer.length){let i=this.buffer.length||av;for(;i<t;)i*=2;let s=new Uint8Array(i);this.pos>0&&s.set(this.buffer),this.buffer=s}}view(){let e=this.buffer,t=this.viewCache;if(t.byteLength===e.byteLength)return t;let i=new DataView(e.buffer);return this.viewCache=i,i}finish(){let e=this.buffer.slice(0,this.pos);return this.pos=0,this.stackPos=[],e}fork(){return this.stackPos.push(this.pos),this.ensureCapacity(ma),this.buffer[this.pos++]=0,this}join(){let e=this.stackPos.pop();if(e===void 0)throw new Error("invalid state, fork stack empty");let t=this.pos-e-ma,i=zh(t);return i>ma&&(this.ensureCapacity(i-ma),this.buffer.copyWithin(e+i,e+ma,this.pos)),this.pos=e,this.uint32(t),this.pos+=t,this}tag(e,t){return this.uint32((e<<3|t)>>>0)}raw(e){return this.ensureCapacity(e.length),this.buffer.set(e,this.pos),this.pos+=e.length,this}uint32(e){if(fm(e),this.ensureCapacity(5),e<128)return this.buffer[this.pos++]=e,this;for(;e>127;)this.buffer[this.pos++]=e&127|128,e>>>=7;return this.buffer[this.pos++]=e,this}int32(e){if(Vh(e),e>=0)return this.uint32(e);this.ensureCapacity(10);for(let t=0;t<9;t++)this.buffer[this.pos++]=e&127|128,e>>=7;return this.buffer[this.pos++]=1,this}bool(e){return this.ensureCapacity(1),this.buffer[this.pos++]=e?1:0,this}bytes(e){return this.uint32(e.byteLength),this.raw(e)}string(e){typeof e!="string"&&(e=String(e));let t=e.length;if(t<=pm){this.ensureCapacity(t+1);let c=this.buffer,l=this.pos;c[l++]=t;let u=0;for(;u<t;u++){let h=e.charCodeAt(u);if(h>127)break;c[l++]=h}if(u==t)return this.pos=l,this}this.ensureCapacity(t*3+5);let i=zh(t),s=this.buffer,r=this.pos,{written:o}=this.encodeUtf8Into(e,s.subarray(r+i)),a=zh(o);return a!=i&&s.copyWithin(r+a,r+i,r+i+o),this.uint32(o),this.pos+=o,this}float(e){return cv(e),this.ensureCapacity(4),this.view().setFloat32(this.pos,e,!0),this.pos+=4,this}double(e){return this.ensureCapacity(8),this.view().setFloat64(this.pos,e,!0),this.pos+=8,this}fixed32(e){return fm(e),this.ensureCapacity(4),this.view().setUint32(this.pos,e,!0),this.pos+=4,this}sfixed32(e){return Vh(e),this.ensureCapacity(4),this.view().setInt32(this.pos,e,!0),this.pos+=4,this}sint32(e){return Vh(e),this.uint32((e<<1^e>>31)>>>0)}sfixed64(e){let t=wt.enc(e);this.ensureCapacity(8);let i=this.view();return i.setInt32(this.pos,t.lo,!0),i.setInt32(this.pos+4,t.hi,!0),this.pos+=8,this}fixed64(e){let t=wt.uEnc(e);this.ensureCapacity(8);let i=this.view();return i.setInt32(this.pos,t.lo,!0),i.setInt32(this.pos+4,t.hi,!0),this.pos+=8,this}int64(e){let t=wt.enc(e);return this.writeVarint64(t.lo,t.hi)}sint64(e){let t=wt.enc(e),i=t.hi>>31,s=t.lo<<1^i,r=(t.hi<<1|t.lo>>>31)^i;return this.writeVarint64(s,r)}uint64(e){let t=wt.uEnc(e);return this.writeVarint64(t.lo,t.hi)}writeVarint64(e,t){this.ensureCapacity(10);let i=this.buffer,s=this.pos;for(let a=0;a<28;a=a+7){let c=e>>>a,l=!(!(c>>>7)&&t==0);if(i[s++]=(l?c|128:c)&255,!l)return this.pos=s,this}let r=e>>>28&15|(t&7)<<4,o=t>>3!=0;if(i[s++]=(o?r|128:r)&255,!o)return this.pos=s,this;for(let a=3;a<31;a=a+7){let c=t>>>a,l=!!(c>>>7);if(i[s++]=(l?c|128:c)&255,!l)return this.pos=s,this}return i[s++]=t>>>31&1,this.pos=s,this}},av=128,ma=1,dm=new Uint8Array(0),lv=new DataView(dm.buffer),pm=32;function zh(n){return n<128?1:n<16384?2:n<2097152?3:n<268435456?4:5}var gs=class{constructor(e,t=pa().decodeUtf8){this.decodeUtf8=t,this.varint64Lo=0,this.varint64Hi=0,this.varint64=Hp,this.uint32=Kp,this.buf=e,this.len=e.length,this.pos=0,this.view=new DataView(e.buffer,e.byteOffset,e.byteLength)}tag(){let e=this.pos,t=this.uint32(),i=this.pos-e;if(i>5||i==5&&this.buf[this.pos-1]>15)throw new Error("illegal tag: varint overflows uint32");let s=t>>>3,r=t&7;if(s<=0||r>5)throw new Error("illegal tag: field no "+s+" wire type "+r);return[s,r]}skip(e,t,i=100){let s=this.pos;switch(e){case Ft.Varint:for(;this.buf[this.pos++]&128;);break;case Ft.Bit64:this.pos+=4;case Ft.Bit32:this.pos+=4;break;case Ft.LengthDelimited:let r=this.uint32();this.pos+=r;break;case Ft.StartGroup:if(i<=0)throw new Error("maximum recursion depth reached");for(;;){let[o,a]=this.tag();if(a===Ft.EndGroup){if(t!==void 0&&o!==t)throw new Error("invalid end group tag");break}this.skip(a,o,i-1)}break;default:throw new Error("cant skip wire type "+e)}return this.assertBounds(),this.buf.subarray(s,this.pos)}assertBounds(){if(this.pos>this.len)throw new RangeError("premature EOF")}int32(){return this.uint32()|0}sint32(){let e=this.uint32();return e>>>1^-(e&1)}int64(){return this.varint64(),wt.dec(this.varint64Lo,this.varint64Hi)}uint64(){return this.varint64(),wt.uDec(this.varint64Lo,this.varint64Hi)}sint64(){this.varint64();let e=this.varint64Lo,t=this.varint64Hi,i=-(e&1);return e=(e>>>1|(t&1)<<31)^i,t=t>>>1^i,wt.dec(e,t)}bool(){let e=this.buf[this.pos];return e<128?(this.pos++,e!==0):(this.varint64(),this.varint64Lo!==0||this.varint64Hi!==0)}fixed32(){return this.view.getUint32((this.pos+=4)-4,!0)}sfixed32(){return this.view.getInt32((this.pos+=4)-4,!0)}fixed64(){return wt.uDec(this.sfixed32(),this.sfixed32())}sfixed64(){return wt.dec(this.sfixed32(),this.sfixed32())}float(){return this.view.getFloat32((this.pos+=4)-4,!0)}double(){return this.view.getFloat64((this.pos+=8)-8,!0)}bytes(){let e=this.uint32(),t=this.pos;return this.pos+=e,this.assertBounds(),this.buf.subarray(t,t+e)}string(e){let t=this.uint32(),i=this.pos;this.pos+=t,this.assertBounds();let s=this.buf;if(t<=pm){let r=new Array(t);for(let o=0;o<t;o++){let a=s[i+o];if(a>127)return this.decodeUtf8(s.subarray(i,this.pos),e);r[o]=a}return String.fromCharCode.apply(String,r)}return this.decodeUtf8(s.subarray(i,this.pos),e)}};function Vh(n){if(typeof n=="string")n=Number(n);else if(typeof n!="number")throw new Error("invalid int32: "+typeof n);if(!Number.isInteger(n)||n>Wh||n<Xh)throw new Error("invalid int32: "+n)}function fm(n){if(typeof n=="string")n=Number(n);else if(typeof n!="number")throw new Error("invalid uint32: "+typeof n);if(!Number.isInteger(n)||n>Hh||n<0)throw new Error("invalid uint32: "+n)}function cv(n){if(typeof n=="string"){let e=n;if(n=Number(n),Number.isNaN(n)&&e!=="NaN")throw new Error("invalid float32: "+e)}else if(typeof n!="number")throw new Error("invalid float32: "+typeof n);if(!Number.isFinite(Math.fround(n))&&Number.isFinite(n))throw new Error("invalid float32: "+n)}function mm(n,e){let t=n.fieldKind=="list"?ua(e,n):n.fieldKind=="map"?ha(e,n):Zh(n,e);if(t===!0)return;let i;switch(n.fieldKind){case"list":i=`expected ${ym(n)}, got ${Ol(e)}`;break;case"map":i=`expected ${xm(n)}, got ${Ol(e)}`;break;default:i=Ul(n,e,t)}return new xi(n,i)}function Kh(n,e,t){let i=Zh(n,t);if(i!==!0)return new xi(n,`list item #${e+1}: ${Ul(n,t,i)}`)}function gm(n,e,t){let i=Yh(n.mapKey)(e);if(i!==!0)return new xi(n,`invalid map key: ${Ul({scalar:n.mapKey},e,i)}`);let s=Zh(n,t);if(s!==!0)return new xi(n,`map entry ${Ol(e)}: ${Ul(n,t,s)}`)}function Zh(n,e){return n.scalar!==void 0?Yh(n.scalar)(e):n.enum!==void 0?n.enum.open?Yh(K.INT32)(e):n.enum.values.some(t=>t.number===e):fa(e,n.message)}function Yh(n){switch(n){case K.DOUBLE:return e=>typeof e=="number";case K.FLOAT:return e=>typeof e!="number"?!1:!Number.isFinite(Math.fround(e))&&Number.isFinite(e)?`${e.toFixed()} out of range`:!0;case K.INT32:case K.SFIXED32:case K.SINT32:return e=>typeof e!="number"||!Number.isInteger(e)?!1:e>Wh||e<Xh?`${e.toFixed()} out of range`:!0;case K.FIXED32:case K.UINT32:return e=>typeof e!="number"||!Number.isInteger(e)?!1:e>Hh||e<0?`${e.toFixed()} out of range`:!0;case K.BOOL:return e=>typeof e=="boolean";case K.STRING:return e=>typeof e!="string"?!1:pa().checkUtf8(e)||"invalid UTF8";case K.BYTES:return e=>e instanceof Uint8Array;case K.INT64:case K.SFIXED64:case K.SINT64:return e=>{if(typeof e=="bigint"||typeof e=="number"||typeof e=="string"&&e.length>0)try{return wt.parse(e),!0}catch{return`${e} out of range`}return!1};case K.FIXED64:case K.UINT64:return e=>{if(typeof e=="bigint"||typeof e=="number"||typeof e=="string"&&e.length>0)try{return wt.uParse(e),!0}catch{return`${e} out of range`}return!1}}}function Ul(n,e,t){return t=typeof t=="string"?`: ${t}`:`, got ${Ol(e)}`,n.scalar!==void 0?`expected ${uv(n.scalar)}`+t:n.enum!==void 0?`expected ${n.enum.toString()}`+t:`expected ${_m(n.message)}`+t}function Ol(n){switch(typeof n){case"object":return n===null?"null":n instanceof Uint8Array?`Uint8Array(${n.length})`:Array.isArray(n)?`Array(${n.length})`:ua(n)?ym(n.field()):ha(n)?xm(n.field()):fa(n)?_m(n.desc):ca(n)?`message ${n.$typeName}`:"object";case"string":return n.length>30?"string":`"${n.split('"').join('\\"')}"`;case"boolean":return String(n);case"number":return String(n);case"bigint":return String(n)+"n";default:return typeof n}}function _m(n){return`ReflectMessage (${n.typeName})`}function ym(n){switch(n.listKind){case"message":return`ReflectList (${n.message.toString()})`;case"enum":return`ReflectList (${n.enum.toString()})`;case"scalar":return`ReflectList (${K[n.scalar]})`}}function xm(n){switch(n.mapKind){case"message":return`ReflectMap (${K[n.mapKey]}, ${n.message.toString()})`;case"enum":return`ReflectMap (${K[n.mapKey]}, ${n.enum.toString()})`;case"scalar":return`ReflectMap (${K[n.mapKey]}, ${K[n.scalar]})`}}function uv(n){switch(n){case K.STRING:return"string";case K.BOOL:return"boolean";case K.INT64:case K.SINT64:case K.SFIXED64:return"bigint (int64)";case K.UINT64:case K.FIXED64:return"bigint (uint64)";case K.BYTES:return"Uint8Array";case K.DOUBLE:return"number (float64)";case K.FLOAT:return"number (float32)";case K.FIXED32:case K.UINT32:return"number (uint32)";case K.INT32:case K.SFIXED32:case K.SINT32:return"number (int32)"}}var hv=0;function Gs(n){if(fv(n))return{toMessage:t=>Fl(t),toLocal:t=>Bl(t)};if(n.fieldKind=="message"&&!n.oneof&&ks(n.message)){let t=n.message,i=t.fields[0].localName;return{toMessage:s=>{let r=yi(t);return s!==void 0&&(r[i]=s),r},toLocal:s=>s[i]}}let e=n.message;return{toMessage:t=>t===void 0?yi(e):t,toLocal:t=>t}}function fv(n){return n.message.typeName=="google.protobuf.Struct"&&n.parent.typeName!="google.protobuf.Value"}function Fl(n){let e={$typeName:"google.protobuf.Struct",fields:{}};if(Ni(n))for(let t of Object.keys(n))ms(e.fields,t,bm(n[t]));return e}function Bl(n){let e={};for(let t of Object.keys(n.fields))ms(e,t,vm(n.fields[t]));return e}function vm(n){switch(n.kind.case){case"structValue":return Bl(n.kind.value);case"listValue":return n.kind.value.values.map(vm);case"nullValue":case void 0:return null;default:return n.kind.value}}function bm(n){let e={$typeName:"google.protobuf.Value",kind:{case:void 0}};switch(typeof n){case"number":e.kind={case:"numberValue",value:n};break;case"string":e.kind={case:"stringValue",value:n};break;case"boolean":e.kind={case:"boolValue",value:n};break;case"object":if(n===null)e.kind={case:"nullValue",value:hv};else if(Array.isArray(n)){let t={$typeName:"google.protobuf.ListValue",values:[]};if(Array.isArray(n))for(let i of n)t.values.push(bm(i));e.kind={case:"listValue",value:t}}else e.kind={case:"structValue",value:Fl(n)};break}return e}function ya(n,e,t=!0){return new Gl(n,e,t)}var Sm=new WeakMap,Gl=class{get sortedFields(){let e=Sm.get(this.desc);if(e)return e;let t=this.desc.fields.concat().sort((i,s)=>i.number-s.number);return Sm.set(this.desc,t),t}constructor(e,t,i=!0){this.lists=new Map,this.maps=new Map,this.check=i,this.desc=e,this.message=this[ai]=t??yi(e),this.fields=e.fields,this.oneofs=e.oneofs,this.members=e.members}findNumber(e){return this._fieldsByNumber||(this._fieldsByNumber=new Map(this.desc.fields.map(t=>[t.number,t]))),this._fieldsByNumber.get(e)}oneofCase(e){return _a(this.message,e),jp(this.message,e)}isSet(e){return _a(this.message,e),Qp(this.message,e)}clear(e){_a(this.message,e),im(this.message,e)}get(e){_a(this.message,e);let t=em(this.message,e);switch(e.fieldKind){case"list":let i=this.lists.get(e);return(!i||i[ai]!==t)&&this.lists.set(e,i=new Jh(e,t,this.check)),i;case"map":let s=this.maps.get(e);return(!s||s[ai]!==t)&&this.maps.set(e,s=new jh(e,t,this.check)),s;case"message":return ef(e,t,this.check);case"scalar":return t===void 0?Pi(e.scalar,!1):tf(e,t);case"enum":return t??e.enum.values[0].number}}set(e,t){if(_a(this.message,e),this.check){let s=mm(e,t);if(s)throw s}let i;e.fieldKind=="message"?i=Qh(e,t):ha(t)||ua(t)?i=t[ai]:i=nf(e,t),tm(this.message,e,i)}getUnknown(){return this.message.$unknown}setUnknown(e){this.message.$unknown=e}};function _a(n,e){if(e.parent.typeName!==n.$typeName)throw new xi(e,`cannot use ${e.toString()} with message ${n.$typeName}`,"ForeignFieldError")}var Jh=class{field(){return this._field}get size(){return this._arr.length}constructor(e,t,i){this._field=e,this._arr=this[ai]=t,this.check=i}get(e){let t=this._arr[e];return t===void 0?void 0:qh(this._field,t,this.check)}set(e,t){if(e<0||e>=this._arr.length)throw new xi(this._field,`list item #${e+1}: out of range`);if(this.check){let i=Kh(this._field,e,t);if(i)throw i}this._arr[e]=Mm(this._field,t)}add(e){if(this.check){let t=Kh(this._field,this._arr.length,e);if(t)throw t}this._arr.push(Mm(this._field,e))}clear(){this._arr.splice(0,this._arr.length)}[Symbol.iterator](){return this.values()}keys(){return this._arr.keys()}*values(){for(let e of this._arr)yield qh(this._field,e,this.check)}*entries(){for(let e=0;e<this._arr.length;e++)yield[e,qh(this._field,this._arr[e],this.check)]}};var jh=class{constructor(e,t,i=!0){this.obj=this[ai]=t??{},this.check=i,this._field=e}field(){return this._field}set(e,t){if(this.check){let i=gm(this._field,e,t);if(i)throw i}return ms(this.obj,kl(e),dv(this._field,t)),this}delete(e){let t=kl(e),i=Object.prototype.hasOwnProperty.call(this.obj,t);return i&&delete this.obj[t],i}clear(){for(let e of Object.keys(this.obj))delete this.obj[e]}get(e){let t=nm(this.obj,kl(e));return t!==void 0&&(t=$h(this._field,t,this.check)),t}has(e){return Object.prototype.hasOwnProperty.call(this.obj,kl(e))}*keys(){for(let e of Object.keys(this.obj))yield Em(e,this._field.mapKey)}*entries(){for(let e of Object.entries(this.obj))yield[Em(e[0],this._field.mapKey),$h(this._field,e[1],this.check)]}[Symbol.iterator](){return this.entries()}get size(){return Object.keys(this.obj).length}*values(){for(let e of Object.values(this.obj))yield $h(this._field,e,this.check)}forEach(e,t){for(let i of this.entries())e.call(t,i[1],i[0],this)}};function Qh(n,e){return fa(e)?sm(e.message)&&!n.oneof&&n.fieldKind=="message"?e.message.value:e.desc.typeName=="google.protobuf.Struct"&&n.parent.typeName!="google.protobuf.Value"?Bl(e.message):e.message:e}function ef(n,e,t){return e!==void 0&&(ks(n.message)&&!n.oneof&&n.fieldKind=="message"?e={$typeName:n.message.typeName,value:tf(n.message.fields[0],e)}:n.message.typeName=="google.protobuf.Struct"&&n.parent.typeName!="google.protobuf.Value"&&Ni(e)&&(e=Fl(e))),new Gl(n.message,e,t)}function Mm(n,e){return n.listKind=="message"?Qh(n,e):nf(n,e)}function qh(n,e,t){return n.listKind=="message"?ef(n,e,t):tf(n,e)}function dv(n,e){return n.mapKind=="message"?Qh(n,e):nf(n,e)}function $h(n,e,t){return n.mapKind=="message"?ef(n,e,t):e}function kl(n){return typeof n=="string"||typeof n=="number"?n:String(n)}function Em(n,e){switch(e){case K.STRING:return n;case K.INT32:case K.FIXED32:case K.UINT32:case K.SFIXED32:case K.SINT32:{let t=Number.parseInt(n);if(Number.isFinite(t))return t;break}case K.BOOL:switch(n){case"true":return!0;case"false":return!1}break;case K.UINT64:case K.FIXED64:try{return wt.uParse(n)}catch{}break;default:try{return wt.parse(n)}catch{}break}return n}function tf(n,e){switch(n.scalar){case K.INT64:case K.SFIXED64:case K.SINT64:"longAsString"in n&&n.longAsString&&typeof e=="string"&&(e=wt.parse(e));break;case K.FIXED64:case K.UINT64:"longAsString"in n&&n.longAsString&&typeof e=="string"&&(e=wt.uParse(e));break}return e}function nf(n,e){switch(n.scalar){case K.INT64:case K.SFIXED64:case K.SINT64:"longAsString"in n&&n.longAsString?e=String(e):(typeof e=="string"||typeof e=="number")&&(e=wt.parse(e));break;case K.FIXED64:case K.UINT64:"longAsString"in n&&n.longAsString?e=String(e):(typeof e=="string"||typeof e=="number")&&(e=wt.uParse(e));break}return e}var Tm=Uint8Array.prototype.setFromBase64;function wm(n){let e=n.length,t=e-(e+3>>2);(e&3)==0&&n[e-1]=="="&&(t-=n[e-2]=="="?2:1);let i=new Uint8Array(t),s=-1;if(Tm)try{let r=Tm.call(i,n);r.read==e&&(s=r.written)}catch{}return s<0&&(s=pv(i,n)),s==t?i:i.subarray(0,s)}function pv(n,e){let t=gv(),i=0,s=0,r,o=0;for(let a=0;a<e.length;a++){if(r=t[e.charCodeAt(a)],r===void 0)switch(e[a]){case"=":s=0;case`
`:case"\r":case"	":case" ":continue;default:throw Error("invalid base64 string")}switch(s){case 0:o=r,s=1;break;case 1:n[i++]=o<<2|(r&48)>>4,o=r,s=2;break;case 2:n[i++]=(o&15)<<4|(r&60)>>2,o=r,s=3;break;case 3:n[i++]=(o&3)<<6|r,s=0;break}}if(s==1)throw Error("invalid base64 string");return i}var MC=Uint8Array.prototype.toBase64;var zl,Am,qr;function mv(n){return zl||(zl="ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/".split(""),Am=zl.slice(0,-2).concat("-","_")),n=="url"?Am:zl}function gv(){if(!qr){qr=[];let n=mv("std");for(let e=0;e<n.length;e++)qr[n[e].charCodeAt(0)]=e;qr[45]=n.indexOf("+"),qr[95]=n.indexOf("/")}return qr}function $r(n){let e=!1,t=[];for(let i=0;i<n.length;i++){let s=n.charAt(i);switch(s){case"_":e=!0;break;case"0":case"1":case"2":case"3":case"4":case"5":case"6":case"7":case"8":case"9":t.push(s),e=!1;break;default:e&&(e=!1,s=s.toUpperCase()),t.push(s);break}}return t.join("")}var _v=new Set(["constructor","toString","toJSON","valueOf"]);function Jr(n){return _v.has(n)?n+"$":n}function xa(n){for(let e of n.field)hr(e,"jsonName")||(e.jsonName=$r(e.name));n.nestedType.forEach(xa)}function Rm(n,e){let t=n.values.find(i=>i.name===e);if(!t)throw new Error(`cannot parse ${n} default value: ${e}`);return t.number}function Im(n,e){switch(n){case K.STRING:return e;case K.BYTES:{let t=yv(e);if(t===!1)throw new Error(`cannot parse ${K[n]} default value: ${e}`);return t}case K.INT64:case K.SFIXED64:case K.SINT64:return wt.parse(e);case K.UINT64:case K.FIXED64:return wt.uParse(e);case K.DOUBLE:case K.FLOAT:switch(e){case"inf":return Number.POSITIVE_INFINITY;case"-inf":return Number.NEGATIVE_INFINITY;case"nan":return Number.NaN;default:return parseFloat(e)}case K.BOOL:return e==="true";case K.INT32:case K.UINT32:case K.SINT32:case K.FIXED32:case K.SFIXED32:return parseInt(e,10)}}function yv(n){let e=[],t={tail:n,c:"",next(){return this.tail.length==0?!1:(this.c=this.tail[0],this.tail=this.tail.substring(1),!0)},take(i){if(this.tail.length>=i){let s=this.tail.substring(0,i);return this.tail=this.tail.substring(i),s}return!1}};for(;t.next();)switch(t.c){case"\\":if(t.next())switch(t.c){case"\\":e.push(t.c.charCodeAt(0));break;case"b":e.push(8);break;case"f":e.push(12);break;case"n":e.push(10);break;case"r":e.push(13);break;case"t":e.push(9);break;case"v":e.push(11);break;case"0":case"1":case"2":case"3":case"4":case"5":case"6":case"7":{let i=t.c,s=t.take(2);if(s===!1)return!1;let r=parseInt(i+s,8);if(Number.isNaN(r))return!1;e.push(r);break}case"x":{let i=t.c,s=t.take(2);if(s===!1)return!1;let r=parseInt(i+s,16);if(Number.isNaN(r))return!1;e.push(r);break}case"u":{let i=t.c,s=t.take(4);if(s===!1)return!1;let r=parseInt(i+s,16);if(Number.isNaN(r))return!1;let o=new Uint8Array(4);new DataView(o.buffer).setInt32(0,r,!0),e.push(o[0],o[1],o[2],o[3]);break}case"U":{let i=t.c,s=t.take(8);if(s===!1)return!1;let r=wt.uEnc(i+s),o=new Uint8Array(8),a=new DataView(o.buffer);a.setInt32(0,r.lo,!0),a.setInt32(4,r.hi,!0),e.push(o[0],o[1],o[2],o[3],o[4],o[5],o[6],o[7]);break}}break;default:e.push(t.c.charCodeAt(0))}return new Uint8Array(e)}function*Vl(n){switch(n.kind){case"file":for(let e of n.messages)yield e,yield*Vl(e);yield*n.enums,yield*n.services,yield*n.extensions;break;case"message":for(let e of n.nestedMessages)yield e,yield*Vl(e);yield*n.nestedEnums,yield*n.nestedExtensions;break}}function Hl(n,e){return xv([n,e])}function xv(n,e){let t=vv();if(!n.length)return t;if("$typeName"in n[0]&&n[0].$typeName=="google.protobuf.FileDescriptorSet"){for(let i of n[0].file)e?.(i),Lm(i,t);return t}if("$typeName"in n[0]){let o=function(a){let c=[];for(let l of a.dependency){if(t.getFile(l)!=null||r.has(l))continue;let u=s(l);if(!u)throw new Error(`Unable to resolve ${l}, imported by ${a.name}`);"kind"in u?t.addFile(u,!1,!0):(r.add(u.name),c.push(u))}return c.concat(...c.map(o))},i=n[0],s=n[1],r=new Set;for(let a of[i,...o(i)].reverse())e?.(a),Lm(a,t)}else for(let i of n)for(let s of i.files)t.addFile(s);return t}function vv(){let n=new Map,e=new Map,t=new Map;return{kind:"registry",types:n,extendees:e,[Symbol.iterator](){return n.values()},get files(){return t.values()},addFile(i,s,r){if(t.set(i.proto.name,i),!s)for(let o of Vl(i))this.add(o);if(r)for(let o of i.dependencies)this.addFile(o,s,r)},add(i){if(i.kind=="extension"){let s=e.get(i.extendee.typeName);s||e.set(i.extendee.typeName,s=new Map),s.set(i.number,i)}n.set(i.typeName,i)},get(i){return n.get(i)},getFile(i){return t.get(i)},getMessage(i){let s=n.get(i);return s?.kind=="message"?s:void 0},getEnum(i){let s=n.get(i);return s?.kind=="enum"?s:void 0},getExtension(i){let s=n.get(i);return s?.kind=="extension"?s:void 0},getExtensionFor(i,s){var r;return(r=e.get(i.typeName))===null||r===void 0?void 0:r.get(s)},getService(i){let s=n.get(i);return s?.kind=="service"?s:void 0}}}var bv=998,Sv=999,Mv=9999,Ev=9,ba=10,va=11,Tv=12,Cm=14,lf=3,Av=2,Pm=1,wv=0,sf=1,Nm=2,Rv=3,Iv=1,Cv=2,Pv=1,Nv=2;var Lv=1002,Um={998:{fieldPresence:1,enumType:2,repeatedFieldEncoding:2,utf8Validation:3,messageEncoding:1,jsonFormat:2,enforceNamingStyle:2,defaultSymbolVisibility:1,enforceProtoLimits:1},999:{fieldPresence:2,enumType:1,repeatedFieldEncoding:1,utf8Validation:2,messageEncoding:1,jsonFormat:1,enforceNamingStyle:2,defaultSymbolVisibility:1,enforceProtoLimits:1},1e3:{fieldPresence:1,enumType:1,repeatedFieldEncoding:1,utf8Validation:2,messageEncoding:1,jsonFormat:1,enforceNamingStyle:2,defaultSymbolVisibility:1,enforceProtoLimits:1},1001:{fieldPresence:1,enumType:1,repeatedFieldEncoding:1,utf8Validation:2,messageEncoding:1,jsonFormat:1,enforceNamingStyle:1,defaultSymbolVisibility:2,enforceProtoLimits:1},1002:{fieldPresence:1,enumType:1,repeatedFieldEncoding:1,utf8Validation:2,messageEncoding:1,jsonFormat:1,enforceNamingStyle:3,defaultSymbolVisibility:4,enforceProtoLimits:2}};function Lm(n,e){var t,i;let s={kind:"file",proto:n,deprecated:(i=(t=n.options)===null||t===void 0?void 0:t.deprecated)!==null&&i!==void 0?i:!1,edition:Fv(n),name:n.name.replace(/\.proto$/,""),dependencies:Bv(n,e),enums:[],messages:[],extensions:[],services:[],toString(){return`file ${n.name}`}},r=new Map,o={get(a){return r.get(a)},add(a){var c;Li(((c=a.proto.options)===null||c===void 0?void 0:c.mapEntry)===!0),r.set(a.typeName,a)}};for(let a of n.enumType)Om(a,s,void 0,e);for(let a of n.messageType)Fm(a,s,void 0,e,o);for(let a of n.service)Dv(a,s,e);rf(s,e);for(let a of r.values())of(a,e,o);for(let a of s.messages)of(a,e,o),rf(a,e);e.addFile(s,!0)}function rf(n,e){switch(n.kind){case"file":for(let t of n.proto.extension){let i=af(t,n,e);n.extensions.push(i),e.add(i)}break;case"message":for(let t of n.proto.extension){let i=af(t,n,e);n.nestedExtensions.push(i),e.add(i)}for(let t of n.nestedMessages)rf(t,e);break}}function of(n,e,t){let i=n.proto.oneofDecl.map(r=>Ov(r,n)),s=new Set;for(let r of n.proto.field){let o=Vv(r,i),a=af(r,n,e,o,t);n.fields.push(a),n.field[a.localName]=a,o===void 0?n.members.push(a):(o.fields.push(a),s.has(o)||(s.add(o),n.members.push(o)))}for(let r of i.filter(o=>s.has(o)))n.oneofs.push(r);for(let r of n.nestedMessages)of(r,e,t)}function Om(n,e,t,i){var s,r,o,a,c,l,u,h,f;let d=kv(n.name,n.value),p={kind:"enum",proto:n,deprecated:(r=(s=n.options)===null||s===void 0?void 0:s.deprecated)!==null&&r!==void 0?r:!1,file:e,parent:t,open:!0,name:n.name,typeName:Wl(n,t,e),value:{},values:[],sharedPrefix:d,toString(){return`enum ${this.typeName}`}};p.open=Yv(p),i.add(p);for(let S of n.value){let g=S.name,m={kind:"enum_value",proto:S,deprecated:(a=(o=S.options)===null||o===void 0?void 0:o.deprecated)!==null&&a!==void 0?a:!1,parent:p,name:g,localName:Jr(d==null?g:g.substring(d.length)),number:S.number,jsonName:(c=Gv(S))!==null&&c!==void 0?c:g,toString(){return`enum value ${p.typeName}.${g}`}};p.values.push(m),(l=(h=p.value)[f=S.number])!==null&&l!==void 0||(h[f]=m)}((u=t?.nestedEnums)!==null&&u!==void 0?u:e.enums).push(p)}function Fm(n,e,t,i,s){var r,o,a,c;let l={kind:"message",proto:n,deprecated:(o=(r=n.options)===null||r===void 0?void 0:r.deprecated)!==null&&o!==void 0?o:!1,file:e,parent:t,name:n.name,typeName:Wl(n,t,e),fields:[],field:{},oneofs:[],members:[],nestedEnums:[],nestedMessages:[],nestedExtensions:[],toString(){return`message ${this.typeName}`}};((a=n.options)===null||a===void 0?void 0:a.mapEntry)===!0?s.add(l):(((c=t?.nestedMessages)!==null&&c!==void 0?c:e.messages).push(l),i.add(l));for(let u of n.enumType)Om(u,e,l,i);for(let u of n.nestedType)Fm(u,e,l,i,s)}function Dv(n,e,t){var i,s;let r={kind:"service",proto:n,deprecated:(s=(i=n.options)===null||i===void 0?void 0:i.deprecated)!==null&&s!==void 0?s:!1,file:e,name:n.name,typeName:Wl(n,void 0,e),methods:[],method:{},toString(){return`service ${this.typeName}`}};e.services.push(r),t.add(r);for(let o of n.method){let a=Uv(o,r,t);r.methods.push(a),r.method[a.localName]=a}}function Uv(n,e,t){var i,s,r,o;let a;n.clientStreaming&&n.serverStreaming?a="bidi_streaming":n.clientStreaming?a="client_streaming":n.serverStreaming?a="server_streaming":a="unary";let c=t.getMessage(_s(n.inputType)),l=t.getMessage(_s(n.outputType));Li(c,`invalid MethodDescriptorProto: input_type ${n.inputType} not found`),Li(l,`invalid MethodDescriptorProto: output_type ${n.inputType} not found`);let u=n.name;return{kind:"rpc",proto:n,deprecated:(s=(i=n.options)===null||i===void 0?void 0:i.deprecated)!==null&&s!==void 0?s:!1,parent:e,name:u,localName:Jr(u.length?Jr(u[0].toLowerCase()+u.substring(1)):u),methodKind:a,input:c,output:l,idempotency:(o=(r=n.options)===null||r===void 0?void 0:r.idempotencyLevel)!==null&&o!==void 0?o:wv,toString(){return`rpc ${e.typeName}.${u}`}}}function Ov(n,e){return{kind:"oneof",proto:n,deprecated:!1,parent:e,fields:[],name:n.name,localName:Jr($r(n.name)),toString(){return`oneof ${e.typeName}.${this.name}`}}}function af(n,e,t,i,s){var r,o,a;let c=s===void 0,l={kind:"field",proto:n,deprecated:(o=(r=n.options)===null||r===void 0?void 0:r.deprecated)!==null&&o!==void 0?o:!1,name:n.name,number:n.number,scalar:void 0,message:void 0,enum:void 0,presence:Hv(n,i,c,e),utf8Validation:Kv(n,e),listKind:void 0,mapKind:void 0,mapKey:void 0,delimitedEncoding:void 0,packed:void 0,longAsString:!1,getDefaultValue:void 0},u;if(c){let p=e.kind=="file"?e:e.file,S=e.kind=="file"?void 0:e,g=Wl(n,S,p);l.kind="extension",l.file=p,l.parent=S,l.oneof=void 0,l.typeName=g,l.jsonName=`[${g}]`,u=()=>`extension ${g}`;let m=t.getMessage(_s(n.extendee));Li(m,`invalid FieldDescriptorProto: extendee ${n.extendee} not found`),l.extendee=m}else{let p=e;Li(p.kind=="message"),l.parent=p,l.oneof=i,l.localName=i?$r(n.name):Jr($r(n.name)),l.jsonName=n.jsonName,u=()=>`field ${p.typeName}.${n.name}`}Object.defineProperty(l,"toString",{value:u,writable:!0,enumerable:!0,configurable:!0});let h=n.label,f=n.type,d=(a=n.options)===null||a===void 0?void 0:a.jstype;if(h===lf){let p=f==va?s?.get(_s(n.typeName)):void 0;if(p){l.fieldKind="map";let{key:S,value:g}=Xv(p);return l.mapKey=S.scalar,l.mapKind=g.fieldKind,l.message=g.message,l.delimitedEncoding=!1,l.enum=g.enum,l.scalar=g.scalar,l}switch(l.fieldKind="list",f){case va:case ba:l.listKind="message",l.message=t.getMessage(_s(n.typeName)),Li(l.message),l.delimitedEncoding=Dm(n,e);break;case Cm:l.listKind="enum",l.enum=t.getEnum(_s(n.typeName)),Li(l.enum);break;default:l.listKind="scalar",l.scalar=f,l.longAsString=d==Pm;break}return l.packed=Wv(n,e),l}switch(f){case va:case ba:l.fieldKind="message",l.message=t.getMessage(_s(n.typeName)),Li(l.message,`invalid FieldDescriptorProto: type_name ${n.typeName} not found`),l.delimitedEncoding=Dm(n,e),l.getDefaultValue=()=>{};break;case Cm:{let p=t.getEnum(_s(n.typeName));Li(p!==void 0,`invalid FieldDescriptorProto: type_name ${n.typeName} not found`),l.fieldKind="enum",l.enum=t.getEnum(_s(n.typeName)),l.getDefaultValue=()=>hr(n,"defaultValue")?Rm(p,n.defaultValue):void 0;break}default:{l.fieldKind="scalar",l.scalar=f,l.longAsString=d==Pm,l.getDefaultValue=()=>hr(n,"defaultValue")?Im(f,n.defaultValue):void 0;break}}return l}function Fv(n){switch(n.syntax){case"":case"proto2":return bv;case"proto3":return Sv;case"editions":if(n.edition===Mv)return Lv;if(n.edition in Um)return n.edition;throw new Error(`${n.name}: unsupported edition`);default:throw new Error(`${n.name}: unsupported syntax "${n.syntax}"`)}}function Bv(n,e){return n.dependency.map(t=>{let i=e.getFile(t);if(!i)throw new Error(`Cannot find ${t}, imported by ${n.name}`);return i})}function kv(n,e){let t=zv(n)+"_";for(let i of e){if(!i.name.toLowerCase().startsWith(t))return;let s=i.name.substring(t.length);if(s.length==0||/^\d/.test(s))return}return t}function Gv(n){var e,t;let r;for(let o of(t=(e=n.options)===null||e===void 0?void 0:e.$unknown)!==null&&t!==void 0?t:[]){if(o.no!==998||o.wireType!==Ft.LengthDelimited)continue;let a=new gs(new gs(o.data).bytes());for(;a.pos<a.len;){let[c,l]=a.tag();c===1&&l===Ft.LengthDelimited?r=a.string():a.skip(l,c)}}return r}function zv(n){return(n.substring(0,1)+n.substring(1).replace(/[A-Z]/g,e=>"_"+e)).toLowerCase()}function Wl(n,e,t){let i;return e?i=`${e.typeName}.${n.name}`:t.proto.package.length>0?i=`${t.proto.package}.${n.name}`:i=`${n.name}`,i}function _s(n){return n.startsWith(".")?n.substring(1):n}function Vv(n,e){if(!hr(n,"oneofIndex")||n.proto3Optional)return;let t=e[n.oneofIndex];return Li(t,`invalid FieldDescriptorProto: oneof #${n.oneofIndex} for field #${n.number} not found`),t}function Hv(n,e,t,i){if(n.label==Av)return Rv;if(n.label==lf)return Nm;if(e||n.proto3Optional||t)return sf;let s=fr("fieldPresence",{proto:n,parent:i});return s==Nm&&(n.type==va||n.type==ba)?sf:s}function Wv(n,e){if(n.label!=lf)return!1;switch(n.type){case Ev:case Tv:case ba:case va:return!1}let t=n.options;return t&&hr(t,"packed")?t.packed:Iv==fr("repeatedFieldEncoding",{proto:n,parent:e})}function Xv(n){let e=n.fields.find(i=>i.number===1),t=n.fields.find(i=>i.number===2);return Li(e&&e.fieldKind=="scalar"&&e.scalar!=K.BYTES&&e.scalar!=K.FLOAT&&e.scalar!=K.DOUBLE&&t&&t.fieldKind!="list"&&t.fieldKind!="map"),{key:e,value:t}}function Yv(n){var e;return Pv==fr("enumType",{proto:n.proto,parent:(e=n.parent)!==null&&e!==void 0?e:n.file})}function Dm(n,e){return n.type==ba?!0:Cv==fr("messageEncoding",{proto:n,parent:e})}function Kv(n,e){return Nv==fr("utf8Validation",{proto:n,parent:e})}function fr(n,e){var t,i;let s=(t=e.proto.options)===null||t===void 0?void 0:t.features;if(s){let r=s[n];if(r!=0)return r}if("kind"in e){if(e.kind=="message")return fr(n,(i=e.parent)!==null&&i!==void 0?i:e.file);let r=Um[e.edition];if(!r)throw new Error(`feature default for edition ${e.edition} not found`);return r[n]}return fr(n,e.parent)}function Li(n,e){if(!n)throw new Error(e)}function Bm(n){let e=Zv(n);return e.messageType.forEach(xa),Hl(e,()=>{}).getFile(e.name)}function Zv(n){return Object.assign(Object.create({syntax:"",edition:0}),Object.assign(Object.assign({$typeName:"google.protobuf.FileDescriptorProto",dependency:[],publicDependency:[],weakDependency:[],optionDependency:[],service:[],extension:[]},n),{messageType:n.messageType.map(km),enumType:n.enumType.map(Gm)}))}function km(n){var e,t,i,s,r,o,a,c;return Object.assign(Object.create({visibility:0}),{$typeName:"google.protobuf.DescriptorProto",name:n.name,field:(t=(e=n.field)===null||e===void 0?void 0:e.map(qv))!==null&&t!==void 0?t:[],extension:[],nestedType:(s=(i=n.nestedType)===null||i===void 0?void 0:i.map(km))!==null&&s!==void 0?s:[],enumType:(o=(r=n.enumType)===null||r===void 0?void 0:r.map(Gm))!==null&&o!==void 0?o:[],extensionRange:(c=(a=n.extensionRange)===null||a===void 0?void 0:a.map(u=>Object.assign({$typeName:"google.protobuf.DescriptorProto.ExtensionRange"},u)))!==null&&c!==void 0?c:[],oneofDecl:[],reservedRange:[],reservedName:[]})}function qv(n){return Object.assign(Object.create({label:1,typeName:"",extendee:"",defaultValue:"",oneofIndex:0,jsonName:"",proto3Optional:!1}),Object.assign(Object.assign({$typeName:"google.protobuf.FieldDescriptorProto"},n),{options:n.options?$v(n.options):void 0}))}function $v(n){var e,t,i;return Object.assign(Object.create({ctype:0,packed:!1,jstype:0,lazy:!1,unverifiedLazy:!1,deprecated:!1,weak:!1,debugRedact:!1,retention:0}),Object.assign(Object.assign({$typeName:"google.protobuf.FieldOptions"},n),{targets:(e=n.targets)!==null&&e!==void 0?e:[],editionDefaults:(i=(t=n.editionDefaults)===null||t===void 0?void 0:t.map(r=>Object.assign({$typeName:"google.protobuf.FieldOptions.EditionDefault"},r)))!==null&&i!==void 0?i:[],uninterpretedOption:[]}))}function Gm(n){return Object.assign(Object.create({visibility:0}),{$typeName:"google.protobuf.EnumDescriptorProto",name:n.name,reservedName:[],reservedRange:[],value:n.value.map(t=>Object.assign({$typeName:"google.protobuf.EnumValueDescriptorProto"},t))})}function ji(n,e,...t){return t.reduce((i,s)=>i.nestedMessages[s],n.messages[e])}var Jv=Bm({name:"google/protobuf/descriptor.proto",package:"google.protobuf",messageType:[{name:"FileDescriptorSet",field:[{name:"file",number:1,type:11,label:3,typeName:".google.protobuf.FileDescriptorProto"}],extensionRange:[{start:536e6,end:536000001}]},{name:"FileDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"package",number:2,type:9,label:1},{name:"dependency",number:3,type:9,label:3},{name:"public_dependency",number:10,type:5,label:3},{name:"weak_dependency",number:11,type:5,label:3},{name:"option_dependency",number:15,type:9,label:3},{name:"message_type",number:4,type:11,label:3,typeName:".google.protobuf.DescriptorProto"},{name:"enum_type",number:5,type:11,label:3,typeName:".google.protobuf.EnumDescriptorProto"},{name:"service",number:6,type:11,label:3,typeName:".google.protobuf.ServiceDescriptorProto"},{name:"extension",number:7,type:11,label:3,typeName:".google.protobuf.FieldDescriptorProto"},{name:"options",number:8,type:11,label:1,typeName:".google.protobuf.FileOptions"},{name:"source_code_info",number:9,type:11,label:1,typeName:".google.protobuf.SourceCodeInfo"},{name:"syntax",number:12,type:9,label:1},{name:"edition",number:14,type:14,label:1,typeName:".google.protobuf.Edition"}]},{name:"DescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"field",number:2,type:11,label:3,typeName:".google.protobuf.FieldDescriptorProto"},{name:"extension",number:6,type:11,label:3,typeName:".google.protobuf.FieldDescriptorProto"},{name:"nested_type",number:3,type:11,label:3,typeName:".google.protobuf.DescriptorProto"},{name:"enum_type",number:4,type:11,label:3,typeName:".google.protobuf.EnumDescriptorProto"},{name:"extension_range",number:5,type:11,label:3,typeName:".google.protobuf.DescriptorProto.ExtensionRange"},{name:"oneof_decl",number:8,type:11,label:3,typeName:".google.protobuf.OneofDescriptorProto"},{name:"options",number:7,type:11,label:1,typeName:".google.protobuf.MessageOptions"},{name:"reserved_range",number:9,type:11,label:3,typeName:".google.protobuf.DescriptorProto.ReservedRange"},{name:"reserved_name",number:10,type:9,label:3},{name:"visibility",number:11,type:14,label:1,typeName:".google.protobuf.SymbolVisibility"}],nestedType:[{name:"ExtensionRange",field:[{name:"start",number:1,type:5,label:1},{name:"end",number:2,type:5,label:1},{name:"options",number:3,type:11,label:1,typeName:".google.protobuf.ExtensionRangeOptions"}]},{name:"ReservedRange",field:[{name:"start",number:1,type:5,label:1},{name:"end",number:2,type:5,label:1}]}]},{name:"ExtensionRangeOptions",field:[{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"},{name:"declaration",number:2,type:11,label:3,typeName:".google.protobuf.ExtensionRangeOptions.Declaration",options:{retention:2}},{name:"features",number:50,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"verification",number:3,type:14,label:1,typeName:".google.protobuf.ExtensionRangeOptions.VerificationState",defaultValue:"UNVERIFIED",options:{retention:2}}],nestedType:[{name:"Declaration",field:[{name:"number",number:1,type:5,label:1},{name:"full_name",number:2,type:9,label:1},{name:"type",number:3,type:9,label:1},{name:"reserved",number:5,type:8,label:1},{name:"repeated",number:6,type:8,label:1}]}],enumType:[{name:"VerificationState",value:[{name:"DECLARATION",number:0},{name:"UNVERIFIED",number:1}]}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"FieldDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"number",number:3,type:5,label:1},{name:"label",number:4,type:14,label:1,typeName:".google.protobuf.FieldDescriptorProto.Label"},{name:"type",number:5,type:14,label:1,typeName:".google.protobuf.FieldDescriptorProto.Type"},{name:"type_name",number:6,type:9,label:1},{name:"extendee",number:2,type:9,label:1},{name:"default_value",number:7,type:9,label:1},{name:"oneof_index",number:9,type:5,label:1},{name:"json_name",number:10,type:9,label:1},{name:"options",number:8,type:11,label:1,typeName:".google.protobuf.FieldOptions"},{name:"proto3_optional",number:17,type:8,label:1}],enumType:[{name:"Type",value:[{name:"TYPE_DOUBLE",number:1},{name:"TYPE_FLOAT",number:2},{name:"TYPE_INT64",number:3},{name:"TYPE_UINT64",number:4},{name:"TYPE_INT32",number:5},{name:"TYPE_FIXED64",number:6},{name:"TYPE_FIXED32",number:7},{name:"TYPE_BOOL",number:8},{name:"TYPE_STRING",number:9},{name:"TYPE_GROUP",number:10},{name:"TYPE_MESSAGE",number:11},{name:"TYPE_BYTES",number:12},{name:"TYPE_UINT32",number:13},{name:"TYPE_ENUM",number:14},{name:"TYPE_SFIXED32",number:15},{name:"TYPE_SFIXED64",number:16},{name:"TYPE_SINT32",number:17},{name:"TYPE_SINT64",number:18}]},{name:"Label",value:[{name:"LABEL_OPTIONAL",number:1},{name:"LABEL_REPEATED",number:3},{name:"LABEL_REQUIRED",number:2}]}]},{name:"OneofDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"options",number:2,type:11,label:1,typeName:".google.protobuf.OneofOptions"}]},{name:"EnumDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"value",number:2,type:11,label:3,typeName:".google.protobuf.EnumValueDescriptorProto"},{name:"options",number:3,type:11,label:1,typeName:".google.protobuf.EnumOptions"},{name:"reserved_range",number:4,type:11,label:3,typeName:".google.protobuf.EnumDescriptorProto.EnumReservedRange"},{name:"reserved_name",number:5,type:9,label:3},{name:"visibility",number:6,type:14,label:1,typeName:".google.protobuf.SymbolVisibility"}],nestedType:[{name:"EnumReservedRange",field:[{name:"start",number:1,type:5,label:1},{name:"end",number:2,type:5,label:1}]}]},{name:"EnumValueDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"number",number:2,type:5,label:1},{name:"options",number:3,type:11,label:1,typeName:".google.protobuf.EnumValueOptions"}]},{name:"ServiceDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"method",number:2,type:11,label:3,typeName:".google.protobuf.MethodDescriptorProto"},{name:"options",number:3,type:11,label:1,typeName:".google.protobuf.ServiceOptions"}]},{name:"MethodDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"input_type",number:2,type:9,label:1},{name:"output_type",number:3,type:9,label:1},{name:"options",number:4,type:11,label:1,typeName:".google.protobuf.MethodOptions"},{name:"client_streaming",number:5,type:8,label:1,defaultValue:"false"},{name:"server_streaming",number:6,type:8,label:1,defaultValue:"false"}]},{name:"FileOptions",field:[{name:"java_package",number:1,type:9,label:1},{name:"java_outer_classname",number:8,type:9,label:1},{name:"java_multiple_files",number:10,type:8,label:1,defaultValue:"false",options:{}},{name:"java_generate_equals_and_hash",number:20,type:8,label:1,options:{deprecated:!0}},{name:"java_string_check_utf8",number:27,type:8,label:1,defaultValue:"false"},{name:"optimize_for",number:9,type:14,label:1,typeName:".google.protobuf.FileOptions.OptimizeMode",defaultValue:"SPEED"},{name:"go_package",number:11,type:9,label:1},{name:"cc_generic_services",number:16,type:8,label:1,defaultValue:"false"},{name:"java_generic_services",number:17,type:8,label:1,defaultValue:"false"},{name:"py_generic_services",number:18,type:8,label:1,defaultValue:"false"},{name:"deprecated",number:23,type:8,label:1,defaultValue:"false"},{name:"cc_enable_arenas",number:31,type:8,label:1,defaultValue:"true",options:{}},{name:"objc_class_prefix",number:36,type:9,label:1},{name:"csharp_namespace",number:37,type:9,label:1},{name:"swift_prefix",number:39,type:9,label:1},{name:"php_class_prefix",number:40,type:9,label:1},{name:"php_namespace",number:41,type:9,label:1},{name:"php_metadata_namespace",number:44,type:9,label:1},{name:"ruby_package",number:45,type:9,label:1},{name:"features",number:50,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],enumType:[{name:"OptimizeMode",value:[{name:"SPEED",number:1},{name:"CODE_SIZE",number:2},{name:"LITE_RUNTIME",number:3}]}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"MessageOptions",field:[{name:"message_set_wire_format",number:1,type:8,label:1,defaultValue:"false"},{name:"no_standard_descriptor_accessor",number:2,type:8,label:1,defaultValue:"false"},{name:"deprecated",number:3,type:8,label:1,defaultValue:"false"},{name:"map_entry",number:7,type:8,label:1},{name:"deprecated_legacy_json_field_conflicts",number:11,type:8,label:1,options:{deprecated:!0}},{name:"features",number:12,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"FieldOptions",field:[{name:"ctype",number:1,type:14,label:1,typeName:".google.protobuf.FieldOptions.CType",defaultValue:"STRING"},{name:"packed",number:2,type:8,label:1},{name:"jstype",number:6,type:14,label:1,typeName:".google.protobuf.FieldOptions.JSType",defaultValue:"JS_NORMAL"},{name:"lazy",number:5,type:8,label:1,defaultValue:"false"},{name:"unverified_lazy",number:15,type:8,label:1,defaultValue:"false"},{name:"deprecated",number:3,type:8,label:1,defaultValue:"false"},{name:"weak",number:10,type:8,label:1,defaultValue:"false",options:{deprecated:!0}},{name:"debug_redact",number:16,type:8,label:1,defaultValue:"false"},{name:"retention",number:17,type:14,label:1,typeName:".google.protobuf.FieldOptions.OptionRetention"},{name:"targets",number:19,type:14,label:3,typeName:".google.protobuf.FieldOptions.OptionTargetType"},{name:"edition_defaults",number:20,type:11,label:3,typeName:".google.protobuf.FieldOptions.EditionDefault"},{name:"features",number:21,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"feature_support",number:22,type:11,label:1,typeName:".google.protobuf.FieldOptions.FeatureSupport"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],nestedType:[{name:"EditionDefault",field:[{name:"edition",number:3,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"value",number:2,type:9,label:1}]},{name:"FeatureSupport",field:[{name:"edition_introduced",number:1,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"edition_deprecated",number:2,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"deprecation_warning",number:3,type:9,label:1},{name:"edition_removed",number:4,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"removal_error",number:5,type:9,label:1}]}],enumType:[{name:"CType",value:[{name:"STRING",number:0},{name:"CORD",number:1},{name:"STRING_PIECE",number:2}]},{name:"JSType",value:[{name:"JS_NORMAL",number:0},{name:"JS_STRING",number:1},{name:"JS_NUMBER",number:2}]},{name:"OptionRetention",value:[{name:"RETENTION_UNKNOWN",number:0},{name:"RETENTION_RUNTIME",number:1},{name:"RETENTION_SOURCE",number:2}]},{name:"OptionTargetType",value:[{name:"TARGET_TYPE_UNKNOWN",number:0},{name:"TARGET_TYPE_FILE",number:1},{name:"TARGET_TYPE_EXTENSION_RANGE",number:2},{name:"TARGET_TYPE_MESSAGE",number:3},{name:"TARGET_TYPE_FIELD",number:4},{name:"TARGET_TYPE_ONEOF",number:5},{name:"TARGET_TYPE_ENUM",number:6},{name:"TARGET_TYPE_ENUM_ENTRY",number:7},{name:"TARGET_TYPE_SERVICE",number:8},{name:"TARGET_TYPE_METHOD",number:9}]}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"OneofOptions",field:[{name:"features",number:1,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"EnumOptions",field:[{name:"allow_alias",number:2,type:8,label:1},{name:"deprecated",number:3,type:8,label:1,defaultValue:"false"},{name:"deprecated_legacy_json_field_conflicts",number:6,type:8,label:1,options:{deprecated:!0}},{name:"features",number:7,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"EnumValueOptions",field:[{name:"deprecated",number:1,type:8,label:1,defaultValue:"false"},{name:"features",number:2,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"debug_redact",number:3,type:8,label:1,defaultValue:"false"},{name:"feature_support",number:4,type:11,label:1,typeName:".google.protobuf.FieldOptions.FeatureSupport"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"ServiceOptions",field:[{name:"features",number:34,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"deprecated",number:33,type:8,label:1,defaultValue:"false"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"MethodOptions",field:[{name:"deprecated",number:33,type:8,label:1,defaultValue:"false"},{name:"idempotency_level",number:34,type:14,label:1,typeName:".google.protobuf.MethodOptions.IdempotencyLevel",defaultValue:"IDEMPOTENCY_UNKNOWN"},{name:"features",number:35,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],enumType:[{name:"IdempotencyLevel",value:[{name:"IDEMPOTENCY_UNKNOWN",number:0},{name:"NO_SIDE_EFFECTS",number:1},{name:"IDEMPOTENT",number:2}]}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"UninterpretedOption",field:[{name:"name",number:2,type:11,label:3,typeName:".google.protobuf.UninterpretedOption.NamePart"},{name:"identifier_value",number:3,type:9,label:1},{name:"positive_int_value",number:4,type:4,label:1},{name:"negative_int_value",number:5,type:3,label:1},{name:"double_value",number:6,type:1,label:1},{name:"string_value",number:7,type:12,label:1},{name:"aggregate_value",number:8,type:9,label:1}],nestedType:[{name:"NamePart",field:[{name:"name_part",number:1,type:9,label:2},{name:"is_extension",number:2,type:8,label:2}]}]},{name:"FeatureSet",field:[{name:"field_presence",number:1,type:14,label:1,typeName:".google.protobuf.FeatureSet.FieldPresence",options:{retention:1,targets:[4,1],editionDefaults:[{value:"EXPLICIT",edition:900},{value:"IMPLICIT",edition:999},{value:"EXPLICIT",edition:1e3}]}},{name:"enum_type",number:2,type:14,label:1,typeName:".google.protobuf.FeatureSet.EnumType",options:{retention:1,targets:[6,1],editionDefaults:[{value:"CLOSED",edition:900},{value:"OPEN",edition:999}]}},{name:"repeated_field_encoding",number:3,type:14,label:1,typeName:".google.protobuf.FeatureSet.RepeatedFieldEncoding",options:{retention:1,targets:[4,1],editionDefaults:[{value:"EXPANDED",edition:900},{value:"PACKED",edition:999}]}},{name:"utf8_validation",number:4,type:14,label:1,typeName:".google.protobuf.FeatureSet.Utf8Validation",options:{retention:1,targets:[4,1],editionDefaults:[{value:"NONE",edition:900},{value:"VERIFY",edition:999}]}},{name:"message_encoding",number:5,type:14,label:1,typeName:".google.protobuf.FeatureSet.MessageEncoding",options:{retention:1,targets:[4,1],editionDefaults:[{value:"LENGTH_PREFIXED",edition:900}]}},{name:"json_format",number:6,type:14,label:1,typeName:".google.protobuf.FeatureSet.JsonFormat",options:{retention:1,targets:[3,6,1],editionDefaults:[{value:"LEGACY_BEST_EFFORT",edition:900},{value:"ALLOW",edition:999}]}},{name:"enforce_naming_style",number:7,type:14,label:1,typeName:".google.protobuf.FeatureSet.EnforceNamingStyle",options:{retention:2,targets:[1,2,3,4,5,6,7,8,9],editionDefaults:[{value:"STYLE_LEGACY",edition:900},{value:"STYLE2024",edition:1001},{value:"STYLE2026",edition:1002}]}},{name:"default_symbol_visibility",number:8,type:14,label:1,typeName:".google.protobuf.FeatureSet.VisibilityFeature.DefaultSymbolVisibility",options:{retention:2,targets:[1],editionDefaults:[{value:"EXPORT_ALL",edition:900},{value:"EXPORT_TOP_LEVEL",edition:1001},{value:"STRICT",edition:1002}]}},{name:"enforce_proto_limits",number:9,type:14,label:1,typeName:".google.protobuf.FeatureSet.ProtoLimitsFeature.EnforceProtoLimits",options:{retention:2,targets:[6,3,4,5],editionDefaults:[{value:"LEGACY_NO_EXPLICIT_LIMITS",edition:900},{value:"PROTO_LIMITS2026",edition:1002}]}}],nestedType:[{name:"VisibilityFeature",enumType:[{name:"DefaultSymbolVisibility",value:[{name:"DEFAULT_SYMBOL_VISIBILITY_UNKNOWN",number:0},{name:"EXPORT_ALL",number:1},{name:"EXPORT_TOP_LEVEL",number:2},{name:"LOCAL_ALL",number:3},{name:"STRICT",number:4}]}]},{name:"ProtoLimitsFeature",enumType:[{name:"EnforceProtoLimits",value:[{name:"PROTO_LIMITS_UNKNOWN",number:0},{name:"LEGACY_NO_EXPLICIT_LIMITS",number:1},{name:"PROTO_LIMITS2026",number:2}]}]}],enumType:[{name:"FieldPresence",value:[{name:"FIELD_PRESENCE_UNKNOWN",number:0},{name:"EXPLICIT",number:1},{name:"IMPLICIT",number:2},{name:"LEGACY_REQUIRED",number:3}]},{name:"EnumType",value:[{name:"ENUM_TYPE_UNKNOWN",number:0},{name:"OPEN",number:1},{name:"CLOSED",number:2}]},{name:"RepeatedFieldEncoding",value:[{name:"REPEATED_FIELD_ENCODING_UNKNOWN",number:0},{name:"PACKED",number:1},{name:"EXPANDED",number:2}]},{name:"Utf8Validation",value:[{name:"UTF8_VALIDATION_UNKNOWN",number:0},{name:"VERIFY",number:2},{name:"NONE",number:3}]},{name:"MessageEncoding",value:[{name:"MESSAGE_ENCODING_UNKNOWN",number:0},{name:"LENGTH_PREFIXED",number:1},{name:"DELIMITED",number:2}]},{name:"JsonFormat",value:[{name:"JSON_FORMAT_UNKNOWN",number:0},{name:"ALLOW",number:1},{name:"LEGACY_BEST_EFFORT",number:2}]},{name:"EnforceNamingStyle",value:[{name:"ENFORCE_NAMING_STYLE_UNKNOWN",number:0},{name:"STYLE2024",number:1},{name:"STYLE_LEGACY",number:2},{name:"STYLE2026",number:3}]}],extensionRange:[{start:1e3,end:9995},{start:9995,end:1e4},{start:1e4,end:10001}]},{name:"FeatureSetDefaults",field:[{name:"defaults",number:1,type:11,label:3,typeName:".google.protobuf.FeatureSetDefaults.FeatureSetEditionDefault"},{name:"minimum_edition",number:4,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"maximum_edition",number:5,type:14,label:1,typeName:".google.protobuf.Edition"}],nestedType:[{name:"FeatureSetEditionDefault",field:[{name:"edition",number:3,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"overridable_features",number:4,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"fixed_features",number:5,type:11,label:1,typeName:".google.protobuf.FeatureSet"}]}]},{name:"SourceCodeInfo",field:[{name:"location",number:1,type:11,label:3,typeName:".google.protobuf.SourceCodeInfo.Location"}],nestedType:[{name:"Location",field:[{name:"path",number:1,type:5,label:3,options:{packed:!0}},{name:"span",number:2,type:5,label:3,options:{packed:!0}},{name:"leading_comments",number:3,type:9,label:1},{name:"trailing_comments",number:4,type:9,label:1},{name:"leading_detached_comments",number:6,type:9,label:3}]}],extensionRange:[{start:536e6,end:536000001}]},{name:"GeneratedCodeInfo",field:[{name:"annotation",number:1,type:11,label:3,typeName:".google.protobuf.GeneratedCodeInfo.Annotation"}],nestedType:[{name:"Annotation",field:[{name:"path",number:1,type:5,label:3,options:{packed:!0}},{name:"source_file",number:2,type:9,label:1},{name:"begin",number:3,type:5,label:1},{name:"end",number:4,type:5,label:1},{name:"semantic",number:5,type:14,label:1,typeName:".google.protobuf.GeneratedCodeInfo.Annotation.Semantic"}],enumType:[{name:"Semantic",value:[{name:"NONE",number:0},{name:"SET",number:1},{name:"ALIAS",number:2}]}]}]}],enumType:[{name:"Edition",value:[{name:"EDITION_UNKNOWN",number:0},{name:"EDITION_LEGACY",number:900},{name:"EDITION_PROTO2",number:998},{name:"EDITION_PROTO3",number:999},{name:"EDITION_2023",number:1e3},{name:"EDITION_2024",number:1001},{name:"EDITION_2026",number:1002},{name:"EDITION_UNSTABLE",number:9999},{name:"EDITION_1_TEST_ONLY",number:1},{name:"EDITION_2_TEST_ONLY",number:2},{name:"EDITION_99997_TEST_ONLY",number:99997},{name:"EDITION_99998_TEST_ONLY",number:99998},{name:"EDITION_99999_TEST_ONLY",number:99999},{name:"EDITION_MAX",number:2147483647}]},{name:"SymbolVisibility",value:[{name:"VISIBILITY_UNSET",number:0},{name:"VISIBILITY_LOCAL",number:1},{name:"VISIBILITY_EXPORT",number:2}]}]});var lg=ji(Jv,1);var zm;(function(n){n[n.DECLARATION=0]="DECLARATION",n[n.UNVERIFIED=1]="UNVERIFIED"})(zm||(zm={}));var Vm;(function(n){n[n.DOUBLE=1]="DOUBLE",n[n.FLOAT=2]="FLOAT",n[n.INT64=3]="INT64",n[n.UINT64=4]="UINT64",n[n.INT32=5]="INT32",n[n.FIXED64=6]="FIXED64",n[n.FIXED32=7]="FIXED32",n[n.BOOL=8]="BOOL",n[n.STRING=9]="STRING",n[n.GROUP=10]="GROUP",n[n.MESSAGE=11]="MESSAGE",n[n.BYTES=12]="BYTES",n[n.UINT32=13]="UINT32",n[n.ENUM=14]="ENUM",n[n.SFIXED32=15]="SFIXED32",n[n.SFIXED64=16]="SFIXED64",n[n.SINT32=17]="SINT32",n[n.SINT64=18]="SINT64"})(Vm||(Vm={}));var Hm;(function(n){n[n.OPTIONAL=1]="OPTIONAL",n[n.REPEATED=3]="REPEATED",n[n.REQUIRED=2]="REQUIRED"})(Hm||(Hm={}));var Wm;(function(n){n[n.SPEED=1]="SPEED",n[n.CODE_SIZE=2]="CODE_SIZE",n[n.LITE_RUNTIME=3]="LITE_RUNTIME"})(Wm||(Wm={}));var Xm;(function(n){n[n.STRING=0]="STRING",n[n.CORD=1]="CORD",n[n.STRING_PIECE=2]="STRING_PIECE"})(Xm||(Xm={}));var Ym;(function(n){n[n.JS_NORMAL=0]="JS_NORMAL",n[n.JS_STRING=1]="JS_STRING",n[n.JS_NUMBER=2]="JS_NUMBER"})(Ym||(Ym={}));var Km;(function(n){n[n.RETENTION_UNKNOWN=0]="RETENTION_UNKNOWN",n[n.RETENTION_RUNTIME=1]="RETENTION_RUNTIME",n[n.RETENTION_SOURCE=2]="RETENTION_SOURCE"})(Km||(Km={}));var Zm;(function(n){n[n.TARGET_TYPE_UNKNOWN=0]="TARGET_TYPE_UNKNOWN",n[n.TARGET_TYPE_FILE=1]="TARGET_TYPE_FILE",n[n.TARGET_TYPE_EXTENSION_RANGE=2]="TARGET_TYPE_EXTENSION_RANGE",n[n.TARGET_TYPE_MESSAGE=3]="TARGET_TYPE_MESSAGE",n[n.TARGET_TYPE_FIELD=4]="TARGET_TYPE_FIELD",n[n.TARGET_TYPE_ONEOF=5]="TARGET_TYPE_ONEOF",n[n.TARGET_TYPE_ENUM=6]="TARGET_TYPE_ENUM",n[n.TARGET_TYPE_ENUM_ENTRY=7]="TARGET_TYPE_ENUM_ENTRY",n[n.TARGET_TYPE_SERVICE=8]="TARGET_TYPE_SERVICE",n[n.TARGET_TYPE_METHOD=9]="TARGET_TYPE_METHOD"})(Zm||(Zm={}));var qm;(function(n){n[n.IDEMPOTENCY_UNKNOWN=0]="IDEMPOTENCY_UNKNOWN",n[n.NO_SIDE_EFFECTS=1]="NO_SIDE_EFFECTS",n[n.IDEMPOTENT=2]="IDEMPOTENT"})(qm||(qm={}));var $m;(function(n){n[n.DEFAULT_SYMBOL_VISIBILITY_UNKNOWN=0]="DEFAULT_SYMBOL_VISIBILITY_UNKNOWN",n[n.EXPORT_ALL=1]="EXPORT_ALL",n[n.EXPORT_TOP_LEVEL=2]="EXPORT_TOP_LEVEL",n[n.LOCAL_ALL=3]="LOCAL_ALL",n[n.STRICT=4]="STRICT"})($m||($m={}));var Jm;(function(n){n[n.PROTO_LIMITS_UNKNOWN=0]="PROTO_LIMITS_UNKNOWN",n[n.LEGACY_NO_EXPLICIT_LIMITS=1]="LEGACY_NO_EXPLICIT_LIMITS",n[n.PROTO_LIMITS2026=2]="PROTO_LIMITS2026"})(Jm||(Jm={}));var jm;(function(n){n[n.FIELD_PRESENCE_UNKNOWN=0]="FIELD_PRESENCE_UNKNOWN",n[n.EXPLICIT=1]="EXPLICIT",n[n.IMPLICIT=2]="IMPLICIT",n[n.LEGACY_REQUIRED=3]="LEGACY_REQUIRED"})(jm||(jm={}));var Qm;(function(n){n[n.ENUM_TYPE_UNKNOWN=0]="ENUM_TYPE_UNKNOWN",n[n.OPEN=1]="OPEN",n[n.CLOSED=2]="CLOSED"})(Qm||(Qm={}));var eg;(function(n){n[n.REPEATED_FIELD_ENCODING_UNKNOWN=0]="REPEATED_FIELD_ENCODING_UNKNOWN",n[n.PACKED=1]="PACKED",n[n.EXPANDED=2]="EXPANDED"})(eg||(eg={}));var tg;(function(n){n[n.UTF8_VALIDATION_UNKNOWN=0]="UTF8_VALIDATION_UNKNOWN",n[n.VERIFY=2]="VERIFY",n[n.NONE=3]="NONE"})(tg||(tg={}));var ng;(function(n){n[n.MESSAGE_ENCODING_UNKNOWN=0]="MESSAGE_ENCODING_UNKNOWN",n[n.LENGTH_PREFIXED=1]="LENGTH_PREFIXED",n[n.DELIMITED=2]="DELIMITED"})(ng||(ng={}));var ig;(function(n){n[n.JSON_FORMAT_UNKNOWN=0]="JSON_FORMAT_UNKNOWN",n[n.ALLOW=1]="ALLOW",n[n.LEGACY_BEST_EFFORT=2]="LEGACY_BEST_EFFORT"})(ig||(ig={}));var sg;(function(n){n[n.ENFORCE_NAMING_STYLE_UNKNOWN=0]="ENFORCE_NAMING_STYLE_UNKNOWN",n[n.STYLE2024=1]="STYLE2024",n[n.STYLE_LEGACY=2]="STYLE_LEGACY",n[n.STYLE2026=3]="STYLE2026"})(sg||(sg={}));var rg;(function(n){n[n.NONE=0]="NONE",n[n.SET=1]="SET",n[n.ALIAS=2]="ALIAS"})(rg||(rg={}));var og;(function(n){n[n.EDITION_UNKNOWN=0]="EDITION_UNKNOWN",n[n.EDITION_LEGACY=900]="EDITION_LEGACY",n[n.EDITION_PROTO2=998]="EDITION_PROTO2",n[n.EDITION_PROTO3=999]="EDITION_PROTO3",n[n.EDITION_2023=1e3]="EDITION_2023",n[n.EDITION_2024=1001]="EDITION_2024",n[n.EDITION_2026=1002]="EDITION_2026",n[n.EDITION_UNSTABLE=9999]="EDITION_UNSTABLE",n[n.EDITION_1_TEST_ONLY=1]="EDITION_1_TEST_ONLY",n[n.EDITION_2_TEST_ONLY=2]="EDITION_2_TEST_ONLY",n[n.EDITION_99997_TEST_ONLY=99997]="EDITION_99997_TEST_ONLY",n[n.EDITION_99998_TEST_ONLY=99998]="EDITION_99998_TEST_ONLY",n[n.EDITION_99999_TEST_ONLY=99999]="EDITION_99999_TEST_ONLY",n[n.EDITION_MAX=2147483647]="EDITION_MAX"})(og||(og={}));var ag;(function(n){n[n.VISIBILITY_UNSET=0]="VISIBILITY_UNSET",n[n.VISIBILITY_LOCAL=1]="VISIBILITY_LOCAL",n[n.VISIBILITY_EXPORT=2]="VISIBILITY_EXPORT"})(ag||(ag={}));function cf(n){return Object.assign(Object.assign({readUnknownFields:!0,recursionLimit:100},n),{depth:0})}function dr(n,e,t){let i=yi(n);return uf(n).read(i,new gs(e),cf(t),e.byteLength),i}var cg=new WeakMap;function uf(n){let e=cg.get(n);return e===void 0&&(e=jv(n)),e}function jv(n){let e=String(n),t=new Map,i={read:Qv(e,t),readGroup:eb(e,t)};cg.set(n,i);for(let s of n.fields)t.set(s.number,hg(s));return i}function Qv(n,e){return(t,i,s,r)=>{var o;if(++s.depth>s.recursionLimit)throw new Error(`cannot decode ${n} from binary: maximum recursion depth of ${s.recursionLimit} reached`);let a=i.pos+r,c=(o=t.$unknown)!==null&&o!==void 0?o:[];for(;i.pos<a;){let[l,u]=i.tag(),h=e.get(l);if(h===void 0){let f=i.skip(u,l,s.recursionLimit-s.depth);s.readUnknownFields&&c.push({no:l,wireType:u,data:f});continue}h(t,i,s,u)}c.length>0&&(t.$unknown=c),s.depth--}}function eb(n,e){return(t,i,s,r)=>{var o;if(++s.depth>s.recursionLimit)throw new Error(`cannot decode ${n} from binary: maximum recursion depth of ${s.recursionLimit} reached`);let a,c,l=(o=t.$unknown)!==null&&o!==void 0?o:[];for(;i.pos<i.len&&([a,c]=i.tag(),c!=Ft.EndGroup);){let u=e.get(a);if(u===void 0){let h=i.skip(c,a,s.recursionLimit-s.depth);s.readUnknownFields&&l.push({no:a,wireType:c,data:h});continue}u(t,i,s,c)}if(c!=Ft.EndGroup||a!==r)throw new Error("invalid end group tag");l.length>0&&(t.$unknown=l),s.depth--}}function ug(n,e,t,i,s){hg(t)(n[ai],e,s,i)}function hg(n){switch(n.fieldKind){case"scalar":return tb(n);case"enum":return nb(n);case"message":return ib(n);case"list":return sb(n);case"map":return rb(n)}}function tb(n){let e=Xl(n.scalar,n.utf8Validation,n.longAsString),t=n.localName;if(n.oneof){let i=n.oneof.localName;return(s,r)=>{s[i]={case:t,value:e(r)}}}return(i,s)=>{i[t]=e(s)}}function nb(n){var e;let t=n.localName,i=(e=n.oneof)===null||e===void 0?void 0:e.localName;if(n.enum.open)return i!==void 0?(o,a)=>{o[i]={case:t,value:a.int32()}}:(o,a)=>{o[t]=a.int32()};let s=n.enum.values,r=n.number;return(o,a,c,l)=>{var u;let h=a.int32();if(s.some(f=>f.number===h))i!==void 0?o[i]={case:t,value:h}:o[t]=h;else if(c.readUnknownFields){let f=[];Yp(h,f);let d=(u=o.$unknown)!==null&&u!==void 0?u:[];d.push({no:r,wireType:l,data:new Uint8Array(f)}),o.$unknown=d}}}function ib(n){let e=n.localName,{toMessage:t,toLocal:i}=Gs(n),s=fg(n);if(n.oneof){let r=n.oneof.localName;return(o,a,c)=>{let l=o[r],u=t(l.case===e?l.value:void 0);s(u,a,c),o[r]={case:e,value:i(u)}}}return(r,o,a)=>{let c=t(r[e]);s(c,o,a),r[e]=i(c)}}function fg(n){let e=uf(n.message);if(n.delimitedEncoding){let t=n.number;return(i,s,r)=>e.readGroup(i,s,r,t)}return(t,i,s)=>e.read(t,i,s,i.uint32())}function sb(n){let e=n.localName;if(n.listKind=="message"){let{toMessage:o,toLocal:a}=Gs(n),c=fg(n);return(l,u,h)=>{let f=o(void 0);c(f,u,h),l[e].push(a(f))}}let t=n.listKind=="enum"?K.INT32:n.scalar,i=n.listKind=="scalar"?n.longAsString:!1,s=Xl(t,n.utf8Validation,i),r=t!=K.STRING&&t!=K.BYTES;return(o,a,c,l)=>{let u=o[e];if(l==Ft.LengthDelimited&&r){let h=a.uint32()+a.pos;for(;a.pos<h;)u.push(s(a))}else u.push(s(a))}}function rb(n){let e=n.localName,t=Xl(n.mapKey,n.utf8Validation,!1),i=Pi(n.mapKey,!1),s,r;switch(n.mapKind){case"scalar":{let o=n.scalar,a=Xl(o,n.utf8Validation,!1);if(s=c=>a(c),o==K.BYTES)r=()=>new Uint8Array(0);else{let c=Pi(o,!1);r=()=>c}break}case"enum":{let o=n.enum.values[0].number;s=a=>a.int32(),r=()=>o;break}case"message":{let{toMessage:o,toLocal:a}=Gs(n),c=uf(n.message).read;s=(l,u,h)=>{let f=o(h);return c(f,l,u,l.uint32()),a(f)},r=()=>a(o(void 0));break}}return(o,a,c)=>{let l=o[e],u,h,f=a.uint32(),d=a.pos+f;for(;a.pos<d;){let[p,S]=a.tag();switch(p){case 1:u=t(a);break;case 2:h=s(a,c,h);break;default:a.skip(S,p,c.recursionLimit-c.depth)}}u===void 0&&(u=i),h===void 0&&(h=r()),ms(l,u,h)}}function Xl(n,e,t){switch(n){case K.STRING:return i=>i.string(e);case K.BOOL:return i=>i.bool();case K.DOUBLE:return i=>i.double();case K.FLOAT:return i=>i.float();case K.INT32:return i=>i.int32();case K.INT64:return t?i=>String(i.int64()):i=>i.int64();case K.UINT64:return t?i=>String(i.uint64()):i=>i.uint64();case K.FIXED64:return t?i=>String(i.fixed64()):i=>i.fixed64();case K.BYTES:return i=>i.bytes();case K.FIXED32:return i=>i.fixed32();case K.SFIXED32:return i=>i.sfixed32();case K.SFIXED64:return t?i=>String(i.sfixed64()):i=>i.sfixed64();case K.SINT64:return t?i=>String(i.sint64()):i=>i.sint64();case K.UINT32:return i=>i.uint32();case K.SINT32:return i=>i.sint32()}}function Qi(n,e){var t;let i=dr(lg,wm(n));return i.messageType.forEach(xa),i.dependency=(t=e?.map(r=>r.proto.name))!==null&&t!==void 0?t:[],Hl(i,r=>e?.find(o=>o.proto.name===r)).getFile(i.name)}var ob=2,ab=3,dg={writeUnknownFields:!0};function lb(n){return n?Object.assign(Object.assign({},dg),n):dg}function hf(n,e,t){let i=new ga;return ff(n)(i,lb(t),e),i.finish()}var pg=new WeakMap;function ff(n){let e=pg.get(n);return e===void 0&&(e=cb(n)),e}function cb(n){let e=n.typeName,t=n.fields.concat().sort((o,a)=>o.number-a.number),i=t[0],s=[],r=(o,a,c)=>{if(c.$typeName!==e&&i!==void 0)throw new xi(i,`cannot use ${i} with message ${c.$typeName}`,"ForeignFieldError");for(let u=0;u<s.length;u++)s[u](o,a,c);let l=c.$unknown;if(l!==void 0&&a.writeUnknownFields)for(let u=0;u<l.length;u++){let{no:h,wireType:f,data:d}=l[u];o.tag(h,f).raw(d)}};pg.set(n,r);for(let o of t)s.push(ub(o));return r}function ub(n){switch(n.fieldKind){case"message":case"scalar":case"enum":return hb(n);case"list":return db(n);case"map":return pb(n)}}function hb(n){let e=fb(n),t=n.localName;if(n.oneof){let i=n.oneof.localName;return(s,r,o)=>{let a=o[i];a.case===t&&e(s,r,a.value)}}if(n.presence!=ob){let i=n.presence==ab?`cannot encode ${n} to binary: required field not set`:void 0;return(s,r,o)=>{let a=o[t];if(a!==void 0&&Object.prototype.hasOwnProperty.call(o,t))e(s,r,a);else if(i!==void 0)throw new Error(i)}}if(n.fieldKind=="enum"){let i=n.enum.values[0].number;return(s,r,o)=>{let a=o[t];a!==i&&e(s,r,a)}}switch(n.scalar){case K.BOOL:return(i,s,r)=>{let o=r[t];o!==!1&&e(i,s,o)};case K.STRING:return(i,s,r)=>{let o=r[t];o!==""&&e(i,s,o)};case K.BYTES:return(i,s,r)=>{let o=r[t];(!(o instanceof Uint8Array)||o.byteLength>0)&&e(i,s,o)};case K.DOUBLE:case K.FLOAT:return(i,s,r)=>{let o=r[t];Object.is(o,0)||e(i,s,o)};default:return(i,s,r)=>{let o=r[t];o!=0&&e(i,s,o)}}}function fb(n){switch(n.fieldKind){case"message":{let{toMessage:e}=Gs(n),t=mg(n);return(i,s,r)=>{t(i,s,e(r))}}case"scalar":case"enum":{let e=n.fieldKind=="enum"?K.INT32:n.scalar,t=n.number,i=Kl(e),s=Yl(e,n.parent.typeName,n.name);return(r,o,a)=>{r.tag(t,i),s(r,a)}}}}function db(n){let e=n.localName,t=n.number;switch(n.listKind){case"message":{let{toMessage:i}=Gs(n),s=mg(n);return(r,o,a)=>{let c=a[e];for(let l=0;l<c.length;l++)s(r,o,i(c[l]))}}case"scalar":case"enum":{let i=n.listKind=="enum"?K.INT32:n.scalar,s=Yl(i,n.parent.typeName,n.name);if(n.packed)return(o,a,c)=>{let l=c[e];if(l.length!=0){o.tag(t,Ft.LengthDelimited).fork();for(let u=0;u<l.length;u++)s(o,l[u]);o.join()}};let r=Kl(i);return(o,a,c)=>{let l=c[e];for(let u=0;u<l.length;u++)o.tag(t,r),s(o,l[u])}}}}function pb(n){let e=n.localName,t=n.number,i=mb(n);if(n.mapKind=="message"){let{toMessage:a}=Gs(n),c=ff(n.message);return(l,u,h)=>{let f=h[e],d=Object.keys(f);for(let p=0;p<d.length;p++){let S=d[p];l.tag(t,Ft.LengthDelimited).fork(),i(l,S),l.tag(2,Ft.LengthDelimited).fork(),c(l,u,a(f[S])),l.join(),l.join()}}}let s=n.mapKind=="enum"?K.INT32:n.scalar,r=Kl(s),o=Yl(s,n.parent.typeName,n.name);return(a,c,l)=>{let u=l[e],h=Object.keys(u);for(let f=0;f<h.length;f++){let d=h[f];a.tag(t,Ft.LengthDelimited).fork(),i(a,d),a.tag(2,r),o(a,u[d]),a.join()}}}function mb(n){let e=Kl(n.mapKey),t=Yl(n.mapKey,n.parent.typeName,n.name),i=gb(n.mapKey);return(s,r)=>{s.tag(1,e),t(s,i(r))}}function gb(n){switch(n){case K.STRING:return e=>e;case K.BOOL:return e=>e==="true"?!0:e==="false"?!1:e;case K.UINT64:case K.FIXED64:return e=>{try{return wt.uParse(e)}catch{return e}};case K.INT64:case K.SFIXED64:case K.SINT64:return e=>{try{return wt.parse(e)}catch{return e}};default:return e=>{let t=Number.parseInt(e);return Number.isFinite(t)?t:e}}}function Yl(n,e,t){let i=_b(n);return(s,r)=>{try{i(s,r)}catch(o){throw o instanceof Error?new Error(`cannot encode field ${e}.${t} to binary: ${o.message}`):o}}}function _b(n){switch(n){case K.STRING:return(e,t)=>e.string(t);case K.BOOL:return(e,t)=>e.bool(t);case K.DOUBLE:return(e,t)=>e.double(t);case K.FLOAT:return(e,t)=>e.float(t);case K.INT32:return(e,t)=>e.int32(t);case K.INT64:return(e,t)=>e.int64(t);case K.UINT64:return(e,t)=>e.uint64(t);case K.FIXED64:return(e,t)=>e.fixed64(t);case K.BYTES:return(e,t)=>e.bytes(t);case K.FIXED32:return(e,t)=>e.fixed32(t);case K.SFIXED32:return(e,t)=>e.sfixed32(t);case K.SFIXED64:return(e,t)=>e.sfixed64(t);case K.SINT64:return(e,t)=>e.sint64(t);case K.UINT32:return(e,t)=>e.uint32(t);case K.SINT32:return(e,t)=>e.sint32(t)}}function mg(n){let e=n.number,t=ff(n.message);return n.delimitedEncoding?(i,s,r)=>{i.tag(e,Ft.StartGroup),t(i,s,r),i.tag(e,Ft.EndGroup)}:(i,s,r)=>{i.tag(e,Ft.LengthDelimited).fork(),t(i,s,r),i.join()}}function Kl(n){switch(n){case K.BYTES:case K.STRING:return Ft.LengthDelimited;case K.DOUBLE:case K.FIXED64:case K.SFIXED64:return Ft.Bit64;case K.FIXED32:case K.SFIXED32:case K.FLOAT:return Ft.Bit32;default:return Ft.Varint}}function xb(n,e){if(n.typeUrl==="")return!1;let t=typeof e=="string"?e:e.typeName,i=gg(n.typeUrl);return t===i}function df(n,e){if(n.typeUrl==="")return;let t=e.kind=="message"?e:e.getMessage(gg(n.typeUrl));if(!(!t||!xb(n,t)))return dr(t,n.value)}function gg(n){let e=n.lastIndexOf("/"),t=e>=0?n.substring(e+1):n;if(!t.length)throw new Error(`invalid type url: ${n}`);return t}function pf(n,e,t){bb(e,n);let i=vb(n.$unknown,e),[s,r,o]=Zl(e),a=cf(t);for(let c of i)ug(s,new gs(c.data),r,c.wireType,a);return o()}function vb(n,e){if(n===void 0)return[];if(e.fieldKind==="enum"||e.fieldKind==="scalar"){for(let t=n.length-1;t>=0;--t)if(n[t].no==e.number)return[n[t]];return[]}return n.filter(t=>t.no===e.number)}function Zl(n,e){let t=n.typeName,i=Object.assign(Object.assign({},n),{kind:"field",parent:n.extendee,localName:t}),s=Object.assign(Object.assign({},n.extendee),{fields:[i],members:[i],oneofs:[]}),r=yi(s,e!==void 0?{[t]:e}:void 0);return[ya(s,r),i,()=>{let o=r[t];if(o===void 0){let a=n.message;return ks(a)?Pi(a.fields[0].scalar,a.fields[0].longAsString):yi(a)}return o}]}function bb(n,e){if(n.extendee.typeName!=e.$typeName)throw new Error(`extension ${n.typeName} can only be applied to message ${n.extendee.typeName}`)}function mf(n,e,t,i){return e.$typeName!=n.typeName||t.$typeName!=n.typeName?!1:e===t?!0:ql(ya(n,e),ya(n,t),i)}function ql(n,e,t){if(n.desc.typeName==="google.protobuf.Any"&&t?.unpackAny==!0)return Sb(n.message,e.message,t);for(let i of n.fields)if(!_g(i,n,e,t))return!1;return!(t?.unknown==!0&&!Mb(n,e,t.registry)||t?.extensions==!0&&!Eb(n,e,t))}function _g(n,e,t,i){if(!e.isSet(n)&&!t.isSet(n))return!0;if(!e.isSet(n)||!t.isSet(n))return!1;switch(n.fieldKind){case"scalar":return Zr(n.scalar,e.get(n),t.get(n));case"enum":return e.get(n)===t.get(n);case"message":return ql(e.get(n),t.get(n),i);case"map":{let s=e.get(n),r=t.get(n),o=[];for(let a of s.keys()){if(!r.has(a))return!1;o.push(a)}for(let a of r.keys())if(!s.has(a))return!1;for(let a of o){let c=s.get(a),l=r.get(a);if(c!==l)switch(n.mapKind){case"enum":return!1;case"message":if(!ql(c,l,i))return!1;break;case"scalar":if(!Zr(n.scalar,c,l))return!1;break}}break}case"list":{let s=e.get(n),r=t.get(n);if(s.size!=r.size)return!1;for(let o=0;o<s.size;o++){let a=s.get(o),c=r.get(o);if(a!==c)switch(n.listKind){case"enum":return!1;case"message":if(!ql(a,c,i))return!1;break;case"scalar":if(!Zr(n.scalar,a,c))return!1;break}}break}}return!0}function Sb(n,e,t){if(n.typeUrl!==e.typeUrl)return!1;let i=df(n,t.registry),s=df(e,t.registry);if(i&&s){let r=t.registry.getMessage(i.$typeName);if(r)return mf(r,i,s,t)}return Zr(K.BYTES,n.value,e.value)}function Mb(n,e,t){function i(o,a){var c;let l=(c=o.getUnknown())!==null&&c!==void 0?c:[];return a?l.filter(u=>!a.getExtensionFor(o.desc,u.no)):l}let s=i(n,t),r=i(e,t);if(s.length!=r.length)return!1;for(let o=0;o<s.length;o++){let a=s[o],c=r[o];if(a.no!=c.no||a.wireType!=c.wireType||!Zr(K.BYTES,a.data,c.data))return!1}return!0}function Eb(n,e,t){function i(o,a){var c;return((c=o.getUnknown())!==null&&c!==void 0?c:[]).map(l=>a.getExtensionFor(o.desc,l.no)).filter(l=>l!=null).filter((l,u,h)=>h.indexOf(l)===u)}let s=i(n,t.registry),r=i(e,t.registry);if(s.length!=r.length||s.some(o=>!r.includes(o)))return!1;for(let o of s){let[a,c]=Zl(o,pf(n.message,o)),[l]=Zl(o,pf(e.message,o));if(!_g(c,a,l,t))return!1}return!0}var Tb="uplot",Ab="u-hz",wb="u-vt",Rb="u-title",Ib="u-wrap",Cb="u-under",Pb="u-over",Nb="u-axis",gr="u-off",Lb="u-select",Db="u-cursor-x",Ub="u-cursor-y",Ob="u-cursor-pt",Fb="u-legend",Bb="u-live",kb="u-inline",Gb="u-series",zb="u-marker",yg="u-label",Vb="u-value",Ma="width",Ea="height";var xg="bottom",jr="left",gf="right",Lf="#000",vg=Lf+"0",_f="mousemove",bg="mousedown",yf="mouseup",Sg="mouseenter",Mg="mouseleave",Eg="dblclick",Hb="resize",Wb="scroll",Tg="change",ec="dppxchange",Df="--",ro=typeof window<"u",Mf=ro?document:null,eo=ro?window:null,Xb=ro?navigator:null,Et,$l;function Ef(){let n=devicePixelRatio;Et!=n&&(Et=n,$l&&Af(Tg,$l,Ef),$l=matchMedia(`(min-resolution: ${Et-.001}dppx) and (max-resolution: ${Et+.001}dppx)`),_r(Tg,$l,Ef),eo.dispatchEvent(new CustomEvent(ec)))}function li(n,e){if(e!=null){let t=n.classList;!t.contains(e)&&t.add(e)}}function Tf(n,e){let t=n.classList;t.contains(e)&&t.remove(e)}function Xt(n,e,t){n.style[e]=t+"px"}function Di(n,e,t,i){let s=Mf.createElement(n);return e!=null&&li(s,e),t?.insertBefore(s,i),s}function vi(n,e){return Di("div",n,e)}var Ag=new WeakMap;function es(n,e,t,i,s){let r="translate("+e+"px,"+t+"px)",o=Ag.get(n);r!=o&&(n.style.transform=r,Ag.set(n,r),e<0||t<0||e>i||t>s?li(n,gr):Tf(n,gr))}var wg=new WeakMap;function Rg(n,e,t){let i=e+t,s=wg.get(n);i!=s&&(wg.set(n,i),n.style.background=e,n.style.borderColor=t)}var Ig=new WeakMap;function Cg(n,e,t,i){let s=e+""+t,r=Ig.get(n);s!=r&&(Ig.set(n,s),n.style.height=t+"px",n.style.width=e+"px",n.style.marginLeft=i?-e/2+"px":0,n.style.marginTop=i?-t/2+"px":0)}var Uf={passive:!0},Yb={...Uf,capture:!0};function _r(n,e,t,i){e.addEventListener(n,t,i?Yb:Uf)}function Af(n,e,t,i){e.removeEventListener(n,t,Uf)}ro&&Ef();function Ui(n,e,t,i){let s;t=t||0,i=i||e.length-1;let r=i<=2147483647;for(;i-t>1;)s=r?t+i>>1:ci((t+i)/2),e[s]<n?t=s:i=s;return n-e[t]<=e[i]-n?t:i}function s0(n){return(t,i,s)=>{let r=-1,o=-1;for(let a=i;a<=s;a++)if(n(t[a])){r=a;break}for(let a=s;a>=i;a--)if(n(t[a])){o=a;break}return[r,o]}}var r0=n=>n!=null,o0=n=>n!=null&&n>0,ic=s0(r0),Kb=s0(o0);function Zb(n,e,t,i=0,s=!1){let r=s?Kb:ic,o=s?o0:r0;[e,t]=r(n,e,t);let a=n[e],c=n[e];if(e>-1)if(i==1)a=n[e],c=n[t];else if(i==-1)a=n[t],c=n[e];else for(let l=e;l<=t;l++){let u=n[l];o(u)&&(u<a?a=u:u>c&&(c=u))}return[a??Bt,c??-Bt]}function sc(n,e,t,i){let s=Lg(n),r=Lg(e);n==e&&(s==-1?(n*=t,e/=t):(n/=t,e*=t));let o=t==10?ys:a0,a=s==1?ci:bi,c=r==1?bi:ci,l=a(o(xn(n))),u=c(o(xn(e))),h=to(t,l),f=to(t,u);return t==10&&(l<0&&(h=kt(h,-l)),u<0&&(f=kt(f,-u))),i||t==2?(n=h*s,e=f*r):(n=h0(n,h),e=rc(e,f)),[n,e]}function Of(n,e,t,i){let s=sc(n,e,t,i);return n==0&&(s[0]=0),e==0&&(s[1]=0),s}var Ff=.1,Pg={mode:3,pad:Ff},Aa={pad:0,soft:null,mode:0},qb={min:Aa,max:Aa};function tc(n,e,t,i){return oc(t)?Ng(n,e,t):(Aa.pad=t,Aa.soft=i?0:null,Aa.mode=i?3:0,Ng(n,e,qb))}function St(n,e){return n??e}function $b(n,e,t){for(e=St(e,0),t=St(t,n.length-1);e<=t;){if(n[e]!=null)return!0;e++}return!1}function Ng(n,e,t){let i=t.min,s=t.max,r=St(i.pad,0),o=St(s.pad,0),a=St(i.hard,-Bt),c=St(s.hard,Bt),l=St(i.soft,Bt),u=St(s.soft,-Bt),h=St(i.mode,0),f=St(s.mode,0),d=e-n,p=ys(d),S=Kn(xn(n),xn(e)),g=ys(S),m=xn(g-p);(d<1e-24||m>10)&&(d=0,(n==0||e==0)&&(d=1e-24,h==2&&l!=Bt&&(r=0),f==2&&u!=-Bt&&(o=0)));let b=d||S||1e3,I=ys(b),x=to(10,ci(I)),w=b*(d==0?n==0?.1:1:r),A=kt(h0(n-w,x/10),24),_=n>=l&&(h==1||h==3&&A<=l||h==2&&A>=l)?l:Bt,T=Kn(a,A<_&&n>=_?_:Oi(_,A)),F=b*(d==0?e==0?.1:1:o),D=kt(rc(e+F,x/10),24),P=e<=u&&(f==1||f==3&&D>=u||f==2&&D<=u)?u:-Bt,B=Oi(c,D>P&&e<=P?P:Kn(P,D));return T==B&&T==0&&(B=100),[T,B]}var Jb=new Intl.NumberFormat(ro?Xb.language:"en-US"),Bf=n=>Jb.format(n),ui=Math,Ql=ui.PI,xn=ui.abs,ci=ui.floor,yn=ui.round,bi=ui.ceil,Oi=ui.min,Kn=ui.max,to=ui.pow,Lg=ui.sign,ys=ui.log10,a0=ui.log2,jb=(n,e=1)=>ui.sinh(n)*e,xf=(n,e=1)=>ui.asinh(n/e),Bt=1/0;function Dg(n){return(ys((n^n>>31)-(n>>31))|0)+1}function wf(n,e,t){return Oi(Kn(n,e),t)}function l0(n){return typeof n=="function"}function yt(n){return l0(n)?n:()=>n}var Qb=()=>{},c0=n=>n,u0=(n,e)=>e,eS=n=>null,Ug=n=>!0,Og=(n,e)=>n==e,tS=/\.\d*?(?=9{6,}|0{6,})/gm,yr=n=>{if(d0(n)||Vs.has(n))return n;let e=`${n}`,t=e.match(tS);if(t==null)return n;let i=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${yr(s)}e${r}`}return kt(n,i)};function pr(n,e){return yr(kt(yr(n/e))*e)}function rc(n,e){return yr(bi(yr(n/e))*e)}function h0(n,e){return yr(ci(yr(n/e))*e)}function kt(n,e=0){if(d0(n))return n;let t=10**e,i=n*t*(1+Number.EPSILON);return yn(i)/t}var Vs=new Map;function f0(n){return((""+n).split(".")[1]||"").length}function Ra(n,e,t,i){let s=[],r=i.map(f0);for(let o=e;o<t;o++){let a=xn(o),c=kt(to(n,o),a);for(let l=0;l<i.length;l++){let u=n==10?+`${i[l]}e${o}`:i[l]*c,h=(o>=0?0:a)+(o>=r[l]?0:r[l]),f=n==10?u:kt(u,h);s.push(f),Vs.set(f,h)}}return s}var wa={},kf=[],no=[null,null],zs=Array.isArray,d0=Number.isInteger,nS=n=>n===void 0;function Fg(n){return typeof n=="string"}function oc(n){let e=!1;if(n!=null){let t=n.constructor;e=t==null||t==Object}return e}function iS(n){return n!=null&&typeof n=="object"}var sS=Object.getPrototypeOf(Uint8Array),p0="__proto__";function io(n,e=oc){let t;if(zs(n)){let i=n.find(s=>s!=null);if(zs(i)||e(i)){t=Array(n.length);for(let s=0;s<n.length;s++)t[s]=io(n[s],e)}else t=n.slice()}else if(n instanceof sS)t=n.slice();else if(e(n)){t={};for(let i in n)i!=p0&&(t[i]=io(n[i],e))}else t=n;return t}function fn(n){let e=arguments;for(let t=1;t<e.length;t++){let i=e[t];for(let s in i)s!=p0&&(oc(n[s])?fn(n[s],io(i[s])):n[s]=io(i[s]))}return n}var rS=0,oS=1,aS=2;function lS(n,e,t){for(let i=0,s,r=-1;i<e.length;i++){let o=e[i];if(o>r){for(s=o-1;s>=0&&n[s]==null;)n[s--]=null;for(s=o+1;s<t&&n[s]==null;)n[r=s++]=null}}}function cS(n,e){if(fS(n)){let o=n[0].slice();for(let a=1;a<n.length;a++)o.push(...n[a].slice(1));return dS(o[0])||(o=hS(o)),o}let t=new Set;for(let o=0;o<n.length;o++){let c=n[o][0],l=c.length;for(let u=0;u<l;u++)t.add(c[u])}let i=[Array.from(t).sort((o,a)=>o-a)],s=i[0].length,r=new Map;for(let o=0;o<s;o++)r.set(i[0][o],o);for(let o=0;o<n.length;o++){let a=n[o],c=a[0];for(let l=1;l<a.length;l++){let u=a[l],h=Array(s).fill(void 0),f=e?e[o][l]:oS,d=[];for(let p=0;p<u.length;p++){let S=u[p],g=r.get(c[p]);S===null?f!=rS&&(h[g]=S,f==aS&&d.push(g)):h[g]=S}lS(h,d,s),i.push(h)}}return i}var uS=typeof queueMicrotask>"u"?n=>Promise.resolve().then(n):queueMicrotask;function hS(n){let e=n[0],t=e.length,i=Array(t);for(let r=0;r<i.length;r++)i[r]=r;i.sort((r,o)=>e[r]-e[o]);let s=[];for(let r=0;r<n.length;r++){let o=n[r],a=Array(t);for(let c=0;c<t;c++)a[c]=o[i[c]];s.push(a)}return s}function fS(n){let e=n[0][0],t=e.length;for(let i=1;i<n.length;i++){let s=n[i][0];if(s.length!=t)return!1;if(s!=e){for(let r=0;r<t;r++)if(s[r]!=e[r])return!1}}return!0}function dS(n,e=100){let t=n.length;if(t<=1)return!0;let i=0,s=t-1;for(;i<=s&&n[i]==null;)i++;for(;s>=i&&n[s]==null;)s--;if(s<=i)return!0;let r=Kn(1,ci((s-i+1)/e));for(let o=n[i],a=i+r;a<=s;a+=r){let c=n[a];if(c!=null){if(c<=o)return!1;o=c}}return!0}var m0=["January","February","March","April","May","June","July","August","September","October","November","December"],g0=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function _0(n){return n.slice(0,3)}var pS=g0.map(_0),mS=m0.map(_0),gS={MMMM:m0,MMM:mS,WWWW:g0,WWW:pS};function Sa(n){return(n<10?"0":"")+n}function _S(n){return(n<10?"00":n<100?"0":"")+n}var yS={YYYY:n=>n.getFullYear(),YY:n=>(n.getFullYear()+"").slice(2),MMMM:(n,e)=>e.MMMM[n.getMonth()],MMM:(n,e)=>e.MMM[n.getMonth()],MM:n=>Sa(n.getMonth()+1),M:n=>n.getMonth()+1,DD:n=>Sa(n.getDate()),D:n=>n.getDate(),WWWW:(n,e)=>e.WWWW[n.getDay()],WWW:(n,e)=>e.WWW[n.getDay()],HH:n=>Sa(n.getHours()),H:n=>n.getHours(),h:n=>{let e=n.getHours();return e==0?12:e>12?e-12:e},AA:n=>n.getHours()>=12?"PM":"AM",aa:n=>n.getHours()>=12?"pm":"am",a:n=>n.getHours()>=12?"p":"a",mm:n=>Sa(n.getMinutes()),m:n=>n.getMinutes(),ss:n=>Sa(n.getSeconds()),s:n=>n.getSeconds(),fff:n=>_S(n.getMilliseconds())};function Gf(n,e){e=e||gS;let t=[],i=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=i.exec(n);)t.push(s[0][0]=="{"?yS[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](r,e);return o}}var xS=new Intl.DateTimeFormat().resolvedOptions().timeZone;function vS(n,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+n+n.getTimezoneOffset()*6e4):e==xS?t=n:(t=new Date(n.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(n.getMilliseconds())),t}var y0=n=>n%1==0,nc=[1,2,2.5,5],bS=Ra(10,-32,0,nc),x0=Ra(10,0,32,nc),SS=x0.filter(y0),mr=bS.concat(x0),zf=`
`,v0="{YYYY}",Bg=zf+v0,b0="{M}/{D}",Ta=zf+b0,Jl=Ta+"/{YY}",S0="{aa}",MS="{h}:{mm}",Qr=MS+S0,kg=zf+Qr,Gg=":{ss}",Rt=null;function M0(n){let e=n*1e3,t=e*60,i=t*60,s=i*24,r=s*30,o=s*365,c=(n==1?Ra(10,0,3,nc).filter(y0):Ra(10,-3,0,nc)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,i,i*2,i*3,i*4,i*6,i*8,i*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),l=[[o,v0,Rt,Rt,Rt,Rt,Rt,Rt,1],[s*28,"{MMM}",Bg,Rt,Rt,Rt,Rt,Rt,1],[s,b0,Bg,Rt,Rt,Rt,Rt,Rt,1],[i,"{h}"+S0,Jl,Rt,Ta,Rt,Rt,Rt,1],[t,Qr,Jl,Rt,Ta,Rt,Rt,Rt,1],[e,Gg,Jl+" "+Qr,Rt,Ta+" "+Qr,Rt,kg,Rt,1],[n,Gg+".{fff}",Jl+" "+Qr,Rt,Ta+" "+Qr,Rt,kg,Rt,1]];function u(h){return(f,d,p,S,g,m)=>{let b=[],I=g>=o,x=g>=r&&g<o,w=h(p),A=kt(w*n,3),_=vf(w.getFullYear(),I?0:w.getMonth(),x||I?1:w.getDate()),T=kt(_*n,3);if(x||I){let F=x?g/r:0,D=I?g/o:0,P=A==T?A:kt(vf(_.getFullYear()+D,_.getMonth()+F,1)*n,3),B=new Date(yn(P/n)),G=B.getFullYear(),N=B.getMonth();for(let V=0;P<=S;V++){let Y=vf(G+D*V,N+F*V,1),z=Y-h(kt(Y*n,3));P=kt((+Y+z)*n,3),P<=S&&b.push(P)}}else{let F=g>=s?s:g,D=ci(p)-ci(A),P=T+D+rc(A-T,F);b.push(P);let B=h(P),G=B.getHours()+B.getMinutes()/t+B.getSeconds()/i,N=g/i,V=f.axes[d]._space,Y=m/V;for(;P=kt(P+g,n==1?0:3),!(P>S);)if(N>1){let z=ci(kt(G+N,6))%24,j=h(P).getHours()-z;j>1&&(j=-1),P-=j*i,G=(G+N)%24;let te=b[b.length-1];kt((P-te)/g,3)*Y>=.7&&b.push(P)}else b.push(P)}return b}}return[c,l,u]}var[ES,TS,AS]=M0(1),[wS,RS,IS]=M0(.001);Ra(2,-53,53,[1]);function zg(n,e){return n.map(t=>t.map((i,s)=>s==0||s==8||i==null?i:e(s==1||t[8]==0?i:t[1]+i)))}function Vg(n,e){return(t,i,s,r,o)=>{let a=e.find(p=>o>=p[0])||e[e.length-1],c,l,u,h,f,d;return i.map(p=>{let S=n(p),g=S.getFullYear(),m=S.getMonth(),b=S.getDate(),I=S.getHours(),x=S.getMinutes(),w=S.getSeconds(),A=g!=c&&a[2]||m!=l&&a[3]||b!=u&&a[4]||I!=h&&a[5]||x!=f&&a[6]||w!=d&&a[7]||a[1];return c=g,l=m,u=b,h=I,f=x,d=w,A(S)})}}function CS(n,e){let t=Gf(e);return(i,s,r,o,a)=>s.map(c=>t(n(c)))}function vf(n,e,t){return new Date(n,e,t)}function Hg(n,e){return e(n)}var PS="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Wg(n,e){return(t,i,s,r)=>r==null?Df:e(n(i))}function NS(n,e){let t=n.series[e];return t.width?t.stroke(n,e):t.points.width?t.points.stroke(n,e):null}function LS(n,e){return n.series[e].fill(n,e)}var DS={show:!0,live:!0,isolate:!1,mount:Qb,markers:{show:!0,width:2,stroke:NS,fill:LS,dash:"solid"},idx:null,idxs:null,values:[]};function US(n,e){let t=n.cursor.points,i=vi(),s=t.size(n,e);Xt(i,Ma,s),Xt(i,Ea,s);let r=s/-2;Xt(i,"marginLeft",r),Xt(i,"marginTop",r);let o=t.width(n,e,s);return o&&Xt(i,"borderWidth",o),i}function OS(n,e){let t=n.series[e].points;return t._fill||t._stroke}function FS(n,e){let t=n.series[e].points;return t._stroke||t._fill}function BS(n,e){return n.series[e].points.size}var bf=[0,0];function kS(n,e,t){return bf[0]=e,bf[1]=t,bf}function jl(n,e,t,i=!0){return s=>{s.button==0&&(!i||s.target==e)&&t(s)}}function Sf(n,e,t,i=!0){return s=>{(!i||s.target==e)&&t(s)}}var GS={show:!0,x:!0,y:!0,lock:!1,move:kS,points:{one:!1,show:US,size:BS,width:0,stroke:FS,fill:OS},bind:{mousedown:jl,mouseup:jl,click:jl,dblclick:jl,mousemove:Sf,mouseleave:Sf,mouseenter:Sf},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(n,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(n,e,t,i,s)=>i-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},E0={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Vf=fn({},E0,{filter:u0}),T0=fn({},Vf,{size:10}),A0=fn({},E0,{show:!1}),Hf='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',w0="bold "+Hf,R0=1.5,Xg={show:!0,scale:"x",stroke:Lf,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:w0,side:2,grid:Vf,ticks:T0,border:A0,font:Hf,lineGap:R0,rotate:0},zS="Value",VS="Time",Yg={show:!0,scale:"x",auto:!1,sorted:1,min:Bt,max:-Bt,idxs:[]};function HS(n,e,t,i,s){return e.map(r=>r==null?"":Bf(r))}function WS(n,e,t,i,s,r,o){let a=[],c=Vs.get(s)||0;t=o?t:kt(rc(t,s),c);for(let l=t;l<=i;l=kt(l+s,c))a.push(Object.is(l,-0)?0:l);return a}function Rf(n,e,t,i,s,r,o){let a=[],c=n.scales[n.axes[e].scale].log,l=c==10?ys:a0,u=ci(l(t));s=to(c,u),c==10&&(s=mr[Ui(s,mr)]);let h=t,f=s*c;c==10&&(f=mr[Ui(f,mr)]);do a.push(h),h=h+s,c==10&&!Vs.has(h)&&(h=kt(h,Vs.get(s))),h>=f&&(s=h,f=s*c,c==10&&(f=mr[Ui(f,mr)]));while(h<=i);return a}function XS(n,e,t,i,s,r,o){let c=n.scales[n.axes[e].scale].asinh,l=i>c?Rf(n,e,Kn(c,t),i,s):[c],u=i>=0&&t<=0?[0]:[];return(t<-c?Rf(n,e,Kn(c,-i),-t,s):[c]).reverse().map(f=>-f).concat(u,l)}var I0=/./,YS=/[12357]/,KS=/[125]/,Kg=/1/,If=(n,e,t,i)=>n.map((s,r)=>e==4&&s==0||r%i==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function ZS(n,e,t,i,s){let r=n.axes[t],o=r.scale,a=n.scales[o],c=n.valToPos,l=r._space,u=c(10,o),h=c(9,o)-u>=l?I0:c(7,o)-u>=l?YS:c(5,o)-u>=l?KS:Kg;if(h==Kg){let f=xn(c(1,o)-u);if(f<l)return If(e.slice().reverse(),a.distr,h,bi(l/f)).reverse()}return If(e,a.distr,h,1)}function qS(n,e,t,i,s){let r=n.axes[t],o=r.scale,a=r._space,c=n.valToPos,l=xn(c(1,o)-c(2,o));return l<a?If(e.slice().reverse(),3,I0,bi(a/l)).reverse():e}function $S(n,e,t,i){return i==null?Df:e==null?"":Bf(e)}var Zg={show:!0,scale:"y",stroke:Lf,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:w0,side:3,grid:Vf,ticks:T0,border:A0,font:Hf,lineGap:R0,rotate:0};function JS(n,e){let t=3+(n||1)*2;return kt(t*e,3)}function jS(n,e){let{scale:t,idxs:i}=n.series[0],s=n._data[0],r=n.valToPos(s[i[0]],t,!0),o=n.valToPos(s[i[1]],t,!0),a=xn(o-r),c=n.series[e],l=a/(c.points.space*Et);return i[1]-i[0]<=l}var qg={scale:null,auto:!0,sorted:0,min:Bt,max:-Bt},C0=(n,e,t,i,s)=>s,$g={show:!0,auto:!0,sorted:0,gaps:C0,alpha:1,facets:[fn({},qg,{scale:"x"}),fn({},qg,{scale:"y"})]},Jg={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:C0,alpha:1,points:{show:jS,filter:null},values:null,min:Bt,max:-Bt,idxs:[],path:null,clip:null};function QS(n,e,t,i,s){return t/10}var P0={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},eM=fn({},P0,{time:!1,ori:1}),jg={};function N0(n,e){let t=jg[n];return t||(t={key:n,plots:[],sub(i){t.plots.push(i)},unsub(i){t.plots=t.plots.filter(s=>s!=i)},pub(i,s,r,o,a,c,l){for(let u=0;u<t.plots.length;u++)t.plots[u]!=s&&t.plots[u].pub(i,s,r,o,a,c,l)}},n!=null&&(jg[n]=t)),t}var so=1,Cf=2;function xr(n,e,t){let i=n.mode,s=n.series[e],r=i==2?n._data[e]:n._data,o=n.scales,a=n.bbox,c=r[0],l=i==2?r[1]:r[e],u=i==2?o[s.facets[0].scale]:o[n.series[0].scale],h=i==2?o[s.facets[1].scale]:o[s.scale],f=a.left,d=a.top,p=a.width,S=a.height,g=n.valToPosH,m=n.valToPosV;return u.ori==0?t(s,c,l,u,h,g,m,f,d,p,S,lc,oo,uc,D0,O0):t(s,c,l,u,h,m,g,d,f,S,p,cc,ao,Yf,U0,F0)}function Wf(n,e){let t=0,i=0,s=St(n.bands,kf);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?i|=1:i|=2)}return[t,i==1?-1:i==2?1:i==3?2:0]}function tM(n,e,t,i,s){let r=n.mode,o=n.series[e],a=r==2?o.facets[1].scale:o.scale,c=n.scales[a];return s==-1?c.min:s==1?c.max:c.distr==3?c.dir==1?c.min:c.max:0}function xs(n,e,t,i,s,r){return xr(n,e,(o,a,c,l,u,h,f,d,p,S,g)=>{let m=o.pxRound,b=l.dir*(l.ori==0?1:-1),I=l.ori==0?oo:ao,x,w;b==1?(x=t,w=i):(x=i,w=t);let A=m(h(a[x],l,S,d)),_=m(f(c[x],u,g,p)),T=m(h(a[w],l,S,d)),F=m(f(r==1?u.max:u.min,u,g,p)),D=new Path2D(s);return I(D,T,F),I(D,A,F),I(D,A,_),D})}function ac(n,e,t,i,s,r){let o=null;if(n.length>0){o=new Path2D;let a=e==0?uc:Yf,c=t;for(let h=0;h<n.length;h++){let f=n[h];if(f[1]>f[0]){let d=f[0]-c;d>0&&a(o,c,i,d,i+r),c=f[1]}}let l=t+s-c,u=10;l>0&&a(o,c,i-u/2,l,i+r+u)}return o}function nM(n,e,t){let i=n[n.length-1];i&&i[0]==e?i[1]=t:n.push([e,t])}function Xf(n,e,t,i,s,r,o){let a=[],c=n.length;for(let l=s==1?t:i;l>=t&&l<=i;l+=s)if(e[l]===null){let h=l,f=l;if(s==1)for(;++l<=i&&e[l]===null;)f=l;else for(;--l>=t&&e[l]===null;)f=l;let d=r(n[h]),p=f==h?d:r(n[f]),S=h-s;d=o<=0&&S>=0&&S<c?r(n[S]):d;let m=f+s;p=o>=0&&m>=0&&m<c?r(n[m]):p,p>=d&&a.push([d,p])}return a}function Qg(n){return n==0?c0:n==1?yn:e=>pr(e,n)}function L0(n){let e=n==0?lc:cc,t=n==0?(s,r,o,a,c,l)=>{s.arcTo(r,o,a,c,l)}:(s,r,o,a,c,l)=>{s.arcTo(o,r,c,a,l)},i=n==0?(s,r,o,a,c)=>{s.rect(r,o,a,c)}:(s,r,o,a,c)=>{s.rect(o,r,c,a)};return(s,r,o,a,c,l=0,u=0)=>{l==0&&u==0?i(s,r,o,a,c):(l=Oi(l,a/2,c/2),u=Oi(u,a/2,c/2),e(s,r+l,o),t(s,r+a,o,r+a,o+c,l),t(s,r+a,o+c,r,o+c,u),t(s,r,o+c,r,o,u),t(s,r,o,r+a,o,l),s.closePath())}}var lc=(n,e,t)=>{n.moveTo(e,t)},cc=(n,e,t)=>{n.moveTo(t,e)},oo=(n,e,t)=>{n.lineTo(e,t)},ao=(n,e,t)=>{n.lineTo(t,e)},uc=L0(0),Yf=L0(1),D0=(n,e,t,i,s,r)=>{n.arc(e,t,i,s,r)},U0=(n,e,t,i,s,r)=>{n.arc(t,e,i,s,r)},O0=(n,e,t,i,s,r,o)=>{n.bezierCurveTo(e,t,i,s,r,o)},F0=(n,e,t,i,s,r,o)=>{n.bezierCurveTo(t,e,s,i,o,r)};function B0(n){return(e,t,i,s,r)=>xr(e,t,(o,a,c,l,u,h,f,d,p,S,g)=>{let{pxRound:m,points:b}=o,I,x;l.ori==0?(I=lc,x=D0):(I=cc,x=U0);let w=kt(b.width*Et,3),A=(b.size-b.width)/2*Et,_=kt(A*2,3),T=new Path2D,F=new Path2D,{left:D,top:P,width:B,height:G}=e.bbox;uc(F,D-_,P-_,B+_*2,G+_*2);let N=V=>{if(c[V]!=null){let Y=m(h(a[V],l,S,d)),z=m(f(c[V],u,g,p));I(T,Y+A,z),x(T,Y,z,A,0,Ql*2)}};if(r)r.forEach(N);else for(let V=i;V<=s;V++)N(V);return{stroke:w>0?T:null,fill:T,clip:F,flags:so|Cf}})}function k0(n){return(e,t,i,s,r,o)=>{i!=s&&(r!=i&&o!=i&&n(e,t,i),r!=s&&o!=s&&n(e,t,s),n(e,t,o))}}var iM=k0(oo),sM=k0(ao);function G0(n){let e=St(n?.alignGaps,0);return(t,i,s,r)=>xr(t,i,(o,a,c,l,u,h,f,d,p,S,g)=>{[s,r]=ic(c,s,r);let m=o.pxRound,b=G=>m(h(G,l,S,d)),I=G=>m(f(G,u,g,p)),x,w;l.ori==0?(x=oo,w=iM):(x=ao,w=sM);let A=l.dir*(l.ori==0?1:-1),_={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:so},T=_.stroke,F=!1;if(r-s>=S*4){let G=he=>t.posToVal(he,l.key,!0),N=null,V=null,Y,z,le,q=b(a[A==1?s:r]),j=b(a[s]),te=b(a[r]),fe=G(A==1?j+1:te-1);for(let he=A==1?s:r;he>=s&&he<=r;he+=A){let ee=a[he],ye=(A==1?ee<fe:ee>fe)?q:b(ee),we=c[he];ye==q?we!=null?(z=we,N==null?(x(T,ye,I(z)),Y=N=V=z):z<N?N=z:z>V&&(V=z)):we===null&&(F=!0):(N!=null&&w(T,q,I(N),I(V),I(Y),I(z)),we!=null?(z=we,x(T,ye,I(z)),N=V=Y=z):(N=V=null,we===null&&(F=!0)),q=ye,fe=G(q+A))}N!=null&&N!=V&&le!=q&&w(T,q,I(N),I(V),I(Y),I(z))}else for(let G=A==1?s:r;G>=s&&G<=r;G+=A){let N=c[G];N===null?F=!0:N!=null&&x(T,b(a[G]),I(N))}let[P,B]=Wf(t,i);if(o.fill!=null||P!=0){let G=_.fill=new Path2D(T),N=o.fillTo(t,i,o.min,o.max,P),V=I(N),Y=b(a[s]),z=b(a[r]);A==-1&&([z,Y]=[Y,z]),x(G,z,V),x(G,Y,V)}if(!o.spanGaps){let G=[];F&&G.push(...Xf(a,c,s,r,A,b,e)),_.gaps=G=o.gaps(t,i,s,r,G),_.clip=ac(G,l.ori,d,p,S,g)}return B!=0&&(_.band=B==2?[xs(t,i,s,r,T,-1),xs(t,i,s,r,T,1)]:xs(t,i,s,r,T,B)),_})}function rM(n){let e=St(n.align,1),t=St(n.ascDesc,!1),i=St(n.alignGaps,0),s=St(n.extend,!1);return(r,o,a,c)=>xr(r,o,(l,u,h,f,d,p,S,g,m,b,I)=>{[a,c]=ic(h,a,c);let x=l.pxRound,{left:w,width:A}=r.bbox,_=j=>x(p(j,f,b,g)),T=j=>x(S(j,d,I,m)),F=f.ori==0?oo:ao,D={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:so},P=D.stroke,B=f.dir*(f.ori==0?1:-1),G=T(h[B==1?a:c]),N=_(u[B==1?a:c]),V=N,Y=N;s&&e==-1&&(Y=w,F(P,Y,G)),F(P,N,G);for(let j=B==1?a:c;j>=a&&j<=c;j+=B){let te=h[j];if(te==null)continue;let fe=_(u[j]),he=T(te);e==1?F(P,fe,G):F(P,V,he),F(P,fe,he),G=he,V=fe}let z=V;s&&e==1&&(z=w+A,F(P,z,G));let[le,q]=Wf(r,o);if(l.fill!=null||le!=0){let j=D.fill=new Path2D(P),te=l.fillTo(r,o,l.min,l.max,le),fe=T(te);F(j,z,fe),F(j,Y,fe)}if(!l.spanGaps){let j=[];j.push(...Xf(u,h,a,c,B,_,i));let te=l.width*Et/2,fe=t||e==1?te:-te,he=t||e==-1?-te:te;j.forEach(ee=>{ee[0]+=fe,ee[1]+=he}),D.gaps=j=l.gaps(r,o,a,c,j),D.clip=ac(j,f.ori,g,m,b,I)}return q!=0&&(D.band=q==2?[xs(r,o,a,c,P,-1),xs(r,o,a,c,P,1)]:xs(r,o,a,c,P,q)),D})}function e0(n,e,t,i,s,r,o=Bt){if(n.length>1){let a=null;for(let c=0,l=1/0;c<n.length;c++)if(e[c]!==void 0){if(a!=null){let u=xn(n[c]-n[a]);u<l&&(l=u,o=xn(t(n[c],i,s,r)-t(n[a],i,s,r)))}a=c}}return o}function oM(n){n=n||wa;let e=St(n.size,[.6,Bt,1]),t=n.align||0,i=n.gap||0,s=n.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=yt(s),o=1-e[0],a=St(e[1],Bt),c=St(e[2],1),l=St(n.disp,wa),u=St(n.each,d=>{}),{fill:h,stroke:f}=l;return(d,p,S,g)=>xr(d,p,(m,b,I,x,w,A,_,T,F,D,P)=>{let B=m.pxRound,G=t,N=i*Et,V=a*Et,Y=c*Et,z,le;x.ori==0?[z,le]=r(d,p):[le,z]=r(d,p);let q=x.dir*(x.ori==0?1:-1),j=x.ori==0?uc:Yf,te=x.ori==0?u:(Ie,Ze,at,Me,Ot,ze,Ke)=>{u(Ie,Ze,at,Ot,Me,Ke,ze)},fe=St(d.bands,kf).find(Ie=>Ie.series[0]==p),he=fe!=null?fe.dir:0,ee=m.fillTo(d,p,m.min,m.max,he),me=B(_(ee,w,P,F)),ye,we,Se,Xe=D,ot=B(m.width*Et),Ve=!1,ft=null,ct=null,it=null,Kt=null;h!=null&&(ot==0||f!=null)&&(Ve=!0,ft=h.values(d,p,S,g),ct=new Map,new Set(ft).forEach(Ie=>{Ie!=null&&ct.set(Ie,new Path2D)}),ot>0&&(it=f.values(d,p,S,g),Kt=new Map,new Set(it).forEach(Ie=>{Ie!=null&&Kt.set(Ie,new Path2D)})));let{x0:Gt,size:on}=l;if(Gt!=null&&on!=null){G=1,b=Gt.values(d,p,S,g),Gt.unit==2&&(b=b.map(at=>d.posToVal(T+at*D,x.key,!0)));let Ie=on.values(d,p,S,g);on.unit==2?we=Ie[0]*D:we=A(Ie[0],x,D,T)-A(0,x,D,T),Xe=e0(b,I,A,x,D,T,Xe),Se=Xe-we+N}else Xe=e0(b,I,A,x,D,T,Xe),Se=Xe*o+N,we=Xe-Se;Se<1&&(Se=0),ot>=we/2&&(ot=0),Se<5&&(B=c0);let Dt=Se>0,wn=Xe-Se-(Dt?ot:0);we=B(wf(wn,Y,V)),ye=(G==0?we/2:G==q?0:we)-G*q*((G==0?N/2:0)+(Dt?ot/2:0));let vt={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},gn=Ve?null:new Path2D,jt=null;if(fe!=null)jt=d.data[fe.series[1]];else{let{y0:Ie,y1:Ze}=l;Ie!=null&&Ze!=null&&(I=Ze.values(d,p,S,g),jt=Ie.values(d,p,S,g))}let an=z*we,O=le*we;for(let Ie=q==1?S:g;Ie>=S&&Ie<=g;Ie+=q){let Ze=I[Ie];if(Ze==null)continue;if(jt!=null){let X=jt[Ie]??0;if(Ze-X==0)continue;me=_(X,w,P,F)}let at=x.distr!=2||l!=null?b[Ie]:Ie,Me=A(at,x,D,T),Ot=_(St(Ze,ee),w,P,F),ze=B(Me-ye),Ke=B(Kn(Ot,me)),R=B(Oi(Ot,me)),v=Ke-R;if(Ze!=null){let X=Ze<0?O:an,ue=Ze<0?an:O;Ve?(ot>0&&it[Ie]!=null&&j(Kt.get(it[Ie]),ze,R+ci(ot/2),we,Kn(0,v-ot),X,ue),ft[Ie]!=null&&j(ct.get(ft[Ie]),ze,R+ci(ot/2),we,Kn(0,v-ot),X,ue)):j(gn,ze,R+ci(ot/2),we,Kn(0,v-ot),X,ue),te(d,p,Ie,ze-ot/2,R,we+ot,v)}}return ot>0?vt.stroke=Ve?Kt:gn:Ve||(vt._fill=m.width==0?m._fill:m._stroke??m._fill,vt.width=0),vt.fill=Ve?ct:gn,vt})}function aM(n,e){let t=St(e?.alignGaps,0);return(i,s,r,o)=>xr(i,s,(a,c,l,u,h,f,d,p,S,g,m)=>{[r,o]=ic(l,r,o);let b=a.pxRound,I=z=>b(f(z,u,g,p)),x=z=>b(d(z,h,m,S)),w,A,_;u.ori==0?(w=lc,_=oo,A=O0):(w=cc,_=ao,A=F0);let T=u.dir*(u.ori==0?1:-1),F=I(c[T==1?r:o]),D=F,P=[],B=[];for(let z=T==1?r:o;z>=r&&z<=o;z+=T)if(l[z]!=null){let q=c[z],j=I(q);P.push(D=j),B.push(x(l[z]))}let G={stroke:n(P,B,w,_,A,b),fill:null,clip:null,band:null,gaps:null,flags:so},N=G.stroke,[V,Y]=Wf(i,s);if(a.fill!=null||V!=0){let z=G.fill=new Path2D(N),le=a.fillTo(i,s,a.min,a.max,V),q=x(le);_(z,D,q),_(z,F,q)}if(!a.spanGaps){let z=[];z.push(...Xf(c,l,r,o,T,I,t)),G.gaps=z=a.gaps(i,s,r,o,z),G.clip=ac(z,u.ori,p,S,g,m)}return Y!=0&&(G.band=Y==2?[xs(i,s,r,o,N,-1),xs(i,s,r,o,N,1)]:xs(i,s,r,o,N,Y)),G})}function lM(n){return aM(cM,n)}function cM(n,e,t,i,s,r){let o=n.length;if(o<2)return null;let a=new Path2D;if(t(a,n[0],e[0]),o==2)i(a,n[1],e[1]);else{let c=Array(o),l=Array(o-1),u=Array(o-1),h=Array(o-1);for(let f=0;f<o-1;f++)u[f]=e[f+1]-e[f],h[f]=n[f+1]-n[f],l[f]=u[f]/h[f];c[0]=l[0];for(let f=1;f<o-1;f++)l[f]===0||l[f-1]===0||l[f-1]>0!=l[f]>0?c[f]=0:(c[f]=3*(h[f-1]+h[f])/((2*h[f]+h[f-1])/l[f-1]+(h[f]+2*h[f-1])/l[f]),isFinite(c[f])||(c[f]=0));c[o-1]=l[o-2];for(let f=0;f<o-1;f++)s(a,n[f]+h[f]/3,e[f]+c[f]*h[f]/3,n[f+1]-h[f]/3,e[f+1]-c[f+1]*h[f]/3,n[f+1],e[f+1])}return a}var Pf=new Set;function t0(){for(let n of Pf)n.syncRect(!0)}ro&&(_r(Hb,eo,t0),_r(Wb,eo,t0,!0),_r(ec,eo,()=>{dn.pxRatio=Et}));var uM=G0(),hM=B0();function n0(n,e,t,i){return(i?[n[0],n[1]].concat(n.slice(2)):[n[0]].concat(n.slice(1))).map((r,o)=>Nf(r,o,e,t))}function fM(n,e){return n.map((t,i)=>i==0?{}:fn({},e,t))}function Nf(n,e,t,i){return fn({},e==0?t:i,n)}function z0(n,e,t){return e==null?no:[e,t]}var dM=z0;function pM(n,e,t){return e==null?no:tc(e,t,Ff,!0)}function V0(n,e,t,i){return e==null?no:sc(e,t,n.scales[i].log,!1)}var mM=V0;function H0(n,e,t,i){return e==null?no:Of(e,t,n.scales[i].log,!1)}var gM=H0;function _M(n,e,t,i,s){let r=Kn(Dg(n),Dg(e)),o=e-n,a=Ui(s/i*o,t);do{let c=t[a],l=i*c/o;if(l>=s&&r+(c<5?Vs.get(c):0)<=17)return[c,l]}while(++a<t.length);return[0,0]}function i0(n){let e,t;return n=n.replace(/(\d+)px/,(i,s)=>(e=yn((t=+s)*Et))+"px"),[n,e,t]}function yM(n){n.show&&[n.font,n.labelFont].forEach(e=>{let t=kt(e[2]*Et,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function dn(n,e,t){let i={mode:St(n.mode,1)},s=i.mode;function r(y,M,C,L){let H=M.valToPct(y);return L+C*(M.dir==-1?1-H:H)}function o(y,M,C,L){let H=M.valToPct(y);return L+C*(M.dir==-1?H:1-H)}function a(y,M,C,L){return M.ori==0?r(y,M,C,L):o(y,M,C,L)}i.valToPosH=r,i.valToPosV=o;let c=!1;i.status=0;let l=i.root=vi(Tb);if(n.id!=null&&(l.id=n.id),li(l,n.class),n.title){let y=vi(Rb,l);y.textContent=n.title}let u=Di("canvas"),h=i.ctx=u.getContext("2d"),f=vi(Ib,l);_r("click",f,y=>{y.target===p&&(Vt!=Hr||Zt!=Wr)&&Dn.click(i,y)},!0);let d=i.under=vi(Cb,f);f.appendChild(u);let p=i.over=vi(Pb,f);n=io(n);let S=+St(n.pxAlign,1),g=Qg(S);(n.plugins||[]).forEach(y=>{y.opts&&(n=y.opts(i,n)||n)});let m=n.ms||.001,b=i.series=s==1?n0(n.series||[],Yg,Jg,!1):fM(n.series||[null],$g),I=i.axes=n0(n.axes||[],Xg,Zg,!0),x=i.scales={},w=i.bands=n.bands||[];w.forEach(y=>{y.fill=yt(y.fill||null),y.dir=St(y.dir,-1)});let A=s==2?b[1].facets[0].scale:b[0].scale,_={axes:ds,series:pt},T=(n.drawOrder||["axes","series"]).map(y=>_[y]);function F(y){let M=y.distr==3?C=>ys(C>0?C:y.clamp(i,C,y.min,y.max,y.key)):y.distr==4?C=>xf(C,y.asinh):y.distr==100?C=>y.fwd(C):C=>C;return C=>{let L=M(C),{_min:H,_max:J}=y,ae=J-H;return(L-H)/ae}}function D(y){let M=x[y];if(M==null){let C=(n.scales||wa)[y]||wa;if(C.from!=null){D(C.from);let L=fn({},x[C.from],C,{key:y});L.valToPct=F(L),x[y]=L}else{M=x[y]=fn({},y==A?P0:eM,C),M.key=y;let L=M.time,H=M.range,J=zs(H);if((y!=A||s==2&&!L)&&(J&&(H[0]==null||H[1]==null)&&(H={min:H[0]==null?Pg:{mode:1,hard:H[0],soft:H[0]},max:H[1]==null?Pg:{mode:1,hard:H[1],soft:H[1]}},J=!1),!J&&oc(H))){let ae=H;H=(de,ve,Le)=>ve==null?no:tc(ve,Le,ae)}M.range=yt(H||(L?dM:y==A?M.distr==3?mM:M.distr==4?gM:z0:M.distr==3?V0:M.distr==4?H0:pM)),M.auto=yt(J?!1:M.auto),M.clamp=yt(M.clamp||QS),M._min=M._max=null,M.valToPct=F(M)}}}D("x"),D("y"),s==1&&b.forEach(y=>{D(y.scale)}),I.forEach(y=>{D(y.scale)});for(let y in n.scales)D(y);let P=x[A],B=P.distr,G,N;P.ori==0?(li(l,Ab),G=r,N=o):(li(l,wb),G=o,N=r);let V={};for(let y in x){let M=x[y];(M.min!=null||M.max!=null)&&(V[y]={min:M.min,max:M.max},M.min=M.max=null)}let Y=n.tzDate||(y=>new Date(yn(y/m))),z=n.fmtDate||Gf,le=m==1?AS(Y):IS(Y),q=Vg(Y,zg(m==1?TS:RS,z)),j=Wg(Y,Hg(PS,z)),te=[],fe=i.legend=fn({},DS,n.legend),he=i.cursor=fn({},GS,{drag:{y:s==2}},n.cursor),ee=fe.show,me=he.show,ye=fe.markers;fe.idxs=te,ye.width=yt(ye.width),ye.dash=yt(ye.dash),ye.stroke=yt(ye.stroke),ye.fill=yt(ye.fill);let we,Se,Xe,ot=[],Ve=[],ft,ct=!1,it={};if(fe.live){let y=b[1]?b[1].values:null;ct=y!=null,ft=ct?y(i,1,0):{_:0};for(let M in ft)it[M]=Df}if(ee)if(we=Di("table",Fb,l),Xe=Di("tbody",null,we),fe.mount(i,we),ct){Se=Di("thead",null,we,Xe);let y=Di("tr",null,Se);Di("th",null,y);for(var Kt in ft)Di("th",yg,y).textContent=Kt}else li(we,kb),fe.live&&li(we,Bb);let Gt={show:!0},on={show:!1};function Dt(y,M){if(M==0&&(ct||!fe.live||s==2))return no;let C=[],L=Di("tr",Gb,Xe,Xe.childNodes[M]);li(L,y.class),y.show||li(L,gr);let H=Di("th",null,L);if(ye.show){let de=vi(zb,H);if(M>0){let ve=ye.width(i,M);ve&&(de.style.border=ve+"px "+ye.dash(i,M)+" "+ye.stroke(i,M)),de.style.background=ye.fill(i,M)}}let J=vi(yg,H);y.label instanceof HTMLElement?J.appendChild(y.label):J.textContent=y.label,M>0&&(ye.show||(J.style.color=y.width>0?ye.stroke(i,M):ye.fill(i,M)),vt("click",H,de=>{if(he._lock)return;Je(de);let ve=b.indexOf(y);if((de.ctrlKey||de.metaKey)!=fe.isolate){let Le=b.some((Ue,Fe)=>Fe>0&&Fe!=ve&&Ue.show);b.forEach((Ue,Fe)=>{Fe>0&&Zi(Fe,Le?Fe==ve?Gt:on:Gt,!0,hn.setSeries)})}else Zi(ve,{show:!y.show},!0,hn.setSeries)},!1),je&&vt(Sg,H,de=>{he._lock||(Je(de),Zi(b.indexOf(y),Yr,!0,hn.setSeries))},!1));for(var ae in ft){let de=Di("td",Vb,L);de.textContent="--",C.push(de)}return[L,C]}let wn=new Map;function vt(y,M,C,L=!0){let H=wn.get(M)||{},J=he.bind[y](i,M,C,L);J&&(_r(y,M,H[y]=J),wn.set(M,H))}function gn(y,M,C){let L=wn.get(M)||{};for(let H in L)(y==null||H==y)&&(Af(H,M,L[H]),delete L[H]);y==null&&wn.delete(M)}let jt=0,an=0,O=0,Ie=0,Ze=0,at=0,Me=Ze,Ot=at,ze=O,Ke=Ie,R=0,v=0,X=0,ue=0;i.bbox={};let oe=!1,_e=!1,xe=!1,ne=!1,se=!1,pe=!1;function U(y,M,C){(C||y!=i.width||M!=i.height)&&re(y,M),ut(!1),xe=!0,_e=!0,Fn()}function re(y,M){i.width=jt=O=y,i.height=an=Ie=M,Ze=at=0,be(),He();let C=i.bbox;R=C.left=pr(Ze*Et,.5),v=C.top=pr(at*Et,.5),X=C.width=pr(O*Et,.5),ue=C.height=pr(Ie*Et,.5)}let ie=3;function Ee(){let y=!1,M=0;for(;!y;){M++;let C=Gr(M),L=Ki(M);y=M==ie||C&&L,y||(re(i.width,i.height),_e=!0)}}function ge({width:y,height:M}){U(y,M)}i.setSize=ge;function be(){let y=!1,M=!1,C=!1,L=!1;I.forEach((H,J)=>{if(H.show&&H._show){let{side:ae,_size:de}=H,ve=ae%2,Le=H.label!=null?H.labelSize:0,Ue=de+Le;Ue>0&&(ve?(O-=Ue,ae==3?(Ze+=Ue,L=!0):C=!0):(Ie-=Ue,ae==0?(at+=Ue,y=!0):M=!0))}}),Xi[0]=y,Xi[1]=C,Xi[2]=M,Xi[3]=L,O-=Ri[1]+Ri[3],Ze+=Ri[3],Ie-=Ri[2]+Ri[0],at+=Ri[0]}function He(){let y=Ze+O,M=at+Ie,C=Ze,L=at;function H(J,ae){switch(J){case 1:return y+=ae,y-ae;case 2:return M+=ae,M-ae;case 3:return C-=ae,C+ae;case 0:return L-=ae,L+ae}}I.forEach((J,ae)=>{if(J.show&&J._show){let de=J.side;J._pos=H(de,J._size),J.label!=null&&(J._lpos=H(de,J.labelSize))}})}if(he.dataIdx==null){let y=he.hover,M=y.skip=new Set(y.skip??[]);M.add(void 0);let C=y.prox=yt(y.prox),L=y.bias??=0;he.dataIdx=(H,J,ae,de)=>{if(J==0)return ae;let ve=ae,Le=C(H,J,ae,de)??Bt,Ue=Le>=0&&Le<Bt,Fe=P.ori==0?O:Ie,st=he.left,Mt=e[0],bt=e[J];if(M.has(bt[ae])){ve=null;let gt=null,$e=null,Ye;if(L==0||L==-1)for(Ye=ae;gt==null&&Ye-- >0;)M.has(bt[Ye])||(gt=Ye);if(L==0||L==1)for(Ye=ae;$e==null&&Ye++<bt.length;)M.has(bt[Ye])||($e=Ye);if(gt!=null||$e!=null)if(Ue){let Wt=gt==null?-1/0:G(Mt[gt],P,Fe,0),tn=$e==null?1/0:G(Mt[$e],P,Fe,0),Pn=st-Wt,Ut=tn-st;Pn<=Ut?Pn<=Le&&(ve=gt):Ut<=Le&&(ve=$e)}else ve=$e==null?gt:gt==null?$e:ae-gt<=$e-ae?gt:$e}else Ue&&xn(st-G(Mt[ae],P,Fe,0))>Le&&(ve=null);return ve}}let Je=y=>{he.event=y};he.idxs=te,he._lock=!1;let ce=he.points;ce.show=yt(ce.show),ce.size=yt(ce.size),ce.stroke=yt(ce.stroke),ce.width=yt(ce.width),ce.fill=yt(ce.fill);let Be=i.focus=fn({},n.focus||{alpha:.3},he.focus),je=Be.prox>=0,Re=je&&ce.one,lt=[],zt=[],Vn=[];function ta(y,M){let C=ce.show(i,M);if(C instanceof HTMLElement)return li(C,Ob),li(C,y.class),es(C,-10,-10,O,Ie),p.insertBefore(C,lt[M]),C}function Fr(y,M){if(s==1||M>0){let C=s==1&&x[y.scale].time,L=y.value;y.value=C?Fg(L)?Wg(Y,Hg(L,z)):L||j:L||$S,y.label=y.label||(C?VS:zS)}if(Re||M>0){y.width=y.width==null?1:y.width,y.paths=y.paths||uM||eS,y.fillTo=yt(y.fillTo||tM),y.pxAlign=+St(y.pxAlign,S),y.pxRound=Qg(y.pxAlign),y.stroke=yt(y.stroke||null),y.fill=yt(y.fill||null),y._stroke=y._fill=y._paths=y._focus=null;let C=JS(Kn(1,y.width),1),L=y.points=fn({},{size:C,width:Kn(1,C*.2),stroke:y.stroke,space:C*2,paths:hM,_stroke:null,_fill:null},y.points);L.show=yt(L.show),L.filter=yt(L.filter),L.fill=yt(L.fill),L.stroke=yt(L.stroke),L.paths=yt(L.paths),L.pxAlign=y.pxAlign}if(ee){let C=Dt(y,M);ot.splice(M,0,C[0]),Ve.splice(M,0,C[1]),fe.values.push(null)}if(me){te.splice(M,0,null);let C=null;Re?M==0&&(C=ta(y,M)):M>0&&(C=ta(y,M)),lt.splice(M,0,C),zt.splice(M,0,0),Vn.splice(M,0,0)}Cn("addSeries",M)}function Th(y,M){M=M??b.length,y=s==1?Nf(y,M,Yg,Jg):Nf(y,M,{},$g),b.splice(M,0,y),Fr(b[M],M)}i.addSeries=Th;function Il(y){if(b.splice(y,1),ee){fe.values.splice(y,1),Ve.splice(y,1);let M=ot.splice(y,1)[0];gn(null,M.firstChild),M.remove()}me&&(te.splice(y,1),lt.splice(y,1)[0].remove(),zt.splice(y,1),Vn.splice(y,1)),Cn("delSeries",y)}i.delSeries=Il;let Xi=[!1,!1,!1,!1];function us(y,M){if(y._show=y.show,y.show){let C=y.side%2,L=x[y.scale];L==null&&(y.scale=C?b[1].scale:A,L=x[y.scale]);let H=L.time;y.size=yt(y.size),y.space=yt(y.space),y.rotate=yt(y.rotate),zs(y.incrs)&&y.incrs.forEach(ae=>{!Vs.has(ae)&&Vs.set(ae,f0(ae))}),y.incrs=yt(y.incrs||(L.distr==2?SS:H?m==1?ES:wS:mr)),y.splits=yt(y.splits||(H&&L.distr==1?le:L.distr==3?Rf:L.distr==4?XS:WS)),y.stroke=yt(y.stroke),y.grid.stroke=yt(y.grid.stroke),y.ticks.stroke=yt(y.ticks.stroke),y.border.stroke=yt(y.border.stroke);let J=y.values;y.values=zs(J)&&!zs(J[0])?yt(J):H?zs(J)?Vg(Y,zg(J,z)):Fg(J)?CS(Y,J):J||q:J||HS,y.filter=yt(y.filter||(L.distr>=3&&L.log==10?ZS:L.distr==3&&L.log==2?qS:u0)),y.font=i0(y.font),y.labelFont=i0(y.labelFont),y._size=y.size(i,null,M,0),y._space=y._rotate=y._incrs=y._found=y._splits=y._values=null,y._size>0&&(Xi[M]=!0,y._el=vi(Nb,f))}}function hs(y,M,C,L){let[H,J,ae,de]=C,ve=M%2,Le=0;return ve==0&&(de||J)&&(Le=M==0&&!H||M==2&&!ae?yn(Xg.size/3):0),ve==1&&(H||ae)&&(Le=M==1&&!J||M==3&&!de?yn(Zg.size/2):0),Le}let na=i.padding=(n.padding||[hs,hs,hs,hs]).map(y=>yt(St(y,hs))),Ri=i._padding=na.map((y,M)=>y(i,M,Xi,0)),Qt,sn=null,rn=null,Yi=s==1?b[0].idxs:null,ii=null,Ls=!1;function ia(y,M){if(e=y??[],i.data=i._data=e,s==2){Qt=0;for(let C=1;C<b.length;C++)Qt+=e[C][0].length}else{e.length==0&&(i.data=i._data=e=[[]]),ii=e[0],Qt=ii.length;let C=e;if(B==2){C=e.slice();let L=C[0]=Array(Qt);for(let H=0;H<Qt;H++)L[H]=H}i._data=e=C}if(ut(!0),Cn("setData"),B==2&&(xe=!0),M!==!1){let C=P;C.auto(i,Ls)?sa():Os(A,C.min,C.max),ne=ne||he.left>=0,pe=!0,Fn()}}i.setData=ia;function sa(){Ls=!0;let y,M;s==1&&(Qt>0?(sn=Yi[0]=0,rn=Yi[1]=Qt-1,y=e[0][sn],M=e[0][rn],B==2?(y=sn,M=rn):y==M&&(B==3?[y,M]=sc(y,y,P.log,!1):B==4?[y,M]=Of(y,y,P.log,!1):P.time?M=y+yn(86400/m):[y,M]=tc(y,M,Ff,!0))):(sn=Yi[0]=y=null,rn=Yi[1]=M=null)),Os(A,y,M)}let Br,Ds,kr,E,k,Q,Z,$,Te,Ce;function Ae(y,M,C,L,H,J){y??=vg,C??=kf,L??="butt",H??=vg,J??="round",y!=Br&&(h.strokeStyle=Br=y),H!=Ds&&(h.fillStyle=Ds=H),M!=kr&&(h.lineWidth=kr=M),J!=k&&(h.lineJoin=k=J),L!=Q&&(h.lineCap=Q=L),C!=E&&h.setLineDash(E=C)}function Pe(y,M,C,L){M!=Ds&&(h.fillStyle=Ds=M),y!=Z&&(h.font=Z=y),C!=$&&(h.textAlign=$=C),L!=Te&&(h.textBaseline=Te=L)}function Ge(y,M,C,L,H=0){if(L.length>0&&y.auto(i,Ls)&&(M==null||M.min==null)){let J=St(sn,0),ae=St(rn,L.length-1),de=C.min==null?Zb(L,J,ae,H,y.distr==3):[C.min,C.max];y.min=Oi(y.min,C.min=de[0]),y.max=Kn(y.max,C.max=de[1])}}let et={min:null,max:null};function dt(){for(let L in x){let H=x[L];V[L]==null&&(H.min==null||V[A]!=null&&H.auto(i,Ls))&&(V[L]=et)}for(let L in x){let H=x[L];V[L]==null&&H.from!=null&&V[H.from]!=null&&(V[L]=et)}V[A]!=null&&ut(!0);let y={};for(let L in V){let H=V[L];if(H!=null){let J=y[L]=io(x[L],iS);if(H.min!=null)fn(J,H);else if(L!=A||s==2)if(Qt==0&&J.from==null){let ae=J.range(i,null,null,L);J.min=ae[0],J.max=ae[1]}else J.min=Bt,J.max=-Bt}}if(Qt>0){b.forEach((L,H)=>{if(s==1){let J=L.scale,ae=V[J];if(ae==null)return;let de=y[J];if(H==0){let ve=de.range(i,de.min,de.max,J);de.min=ve[0],de.max=ve[1],sn=Ui(de.min,e[0]),rn=Ui(de.max,e[0]),rn-sn>1&&(e[0][sn]<de.min&&sn++,e[0][rn]>de.max&&rn--),L.min=ii[sn],L.max=ii[rn]}else L.show&&L.auto&&Ge(de,ae,L,e[H],L.sorted);L.idxs[0]=sn,L.idxs[1]=rn}else if(H>0&&L.show&&L.auto){let[J,ae]=L.facets,de=J.scale,ve=ae.scale,[Le,Ue]=e[H],Fe=y[de],st=y[ve];Fe!=null&&Ge(Fe,V[de],J,Le,J.sorted),st!=null&&Ge(st,V[ve],ae,Ue,ae.sorted),L.min=ae.min,L.max=ae.max}});for(let L in y){let H=y[L],J=V[L];if(H.from==null&&(J==null||J.min==null)){let ae=H.range(i,H.min==Bt?null:H.min,H.max==-Bt?null:H.max,L);H.min=ae[0],H.max=ae[1]}}}for(let L in y){let H=y[L];if(H.from!=null){let J=y[H.from];if(J.min==null)H.min=H.max=null;else{let ae=H.range(i,J.min,J.max,L);H.min=ae[0],H.max=ae[1]}}}let M={},C=!1;for(let L in y){let H=y[L],J=x[L];if(J.min!=H.min||J.max!=H.max){J.min=H.min,J.max=H.max;let ae=J.distr;J._min=ae==3?ys(J.min):ae==4?xf(J.min,J.asinh):ae==100?J.fwd(J.min):J.min,J._max=ae==3?ys(J.max):ae==4?xf(J.max,J.asinh):ae==100?J.fwd(J.max):J.max,M[L]=C=!0}}if(C){b.forEach((L,H)=>{s==2?H>0&&M.y&&(L._paths=null):M[L.scale]&&(L._paths=null)});for(let L in M)xe=!0,Cn("setScale",L);me&&he.left>=0&&(ne=pe=!0)}for(let L in V)V[L]=null}function ke(y){let M=wf(sn-1,0,Qt-1),C=wf(rn+1,0,Qt-1);for(;y[M]==null&&M>0;)M--;for(;y[C]==null&&C<Qt-1;)C++;return[M,C]}function pt(){if(Qt>0){let y=b.some(M=>M._focus)&&Ce!=Be.alpha;y&&(h.globalAlpha=Ce=Be.alpha),b.forEach((M,C)=>{if(C>0&&M.show&&($t(C,!1),$t(C,!0),M._paths==null)){let L=Ce;Ce!=M.alpha&&(h.globalAlpha=Ce=M.alpha);let H=s==2?[0,e[C][0].length-1]:ke(e[C]);M._paths=M.paths(i,C,H[0],H[1]),Ce!=L&&(h.globalAlpha=Ce=L)}}),b.forEach((M,C)=>{if(C>0&&M.show){let L=Ce;Ce!=M.alpha&&(h.globalAlpha=Ce=M.alpha),M._paths!=null&&Pt(C,!1);{let H=M._paths!=null?M._paths.gaps:null,J=M.points.show(i,C,sn,rn,H),ae=M.points.filter(i,C,J,H);(J||ae)&&(M.points._paths=M.points.paths(i,C,sn,rn,ae),Pt(C,!0))}Ce!=L&&(h.globalAlpha=Ce=L),Cn("drawSeries",C)}}),y&&(h.globalAlpha=Ce=1)}}function $t(y,M){let C=M?b[y].points:b[y];C._stroke=C.stroke(i,y),C._fill=C.fill(i,y)}function Pt(y,M){let C=M?b[y].points:b[y],{stroke:L,fill:H,clip:J,flags:ae,_stroke:de=C._stroke,_fill:ve=C._fill,_width:Le=C.width}=C._paths;Le=kt(Le*Et,3);let Ue=null,Fe=Le%2/2;M&&ve==null&&(ve=Le>0?"#fff":de);let st=C.pxAlign==1&&Fe>0;if(st&&h.translate(Fe,Fe),!M){let Mt=R-Le/2,bt=v-Le/2,gt=X+Le,$e=ue+Le;Ue=new Path2D,Ue.rect(Mt,bt,gt,$e)}M?Oe(de,Le,C.dash,C.cap,ve,L,H,ae,J):Nt(y,de,Le,C.dash,C.cap,ve,L,H,ae,Ue,J),st&&h.translate(-Fe,-Fe)}function Nt(y,M,C,L,H,J,ae,de,ve,Le,Ue){let Fe=!1;ve!=0&&w.forEach((st,Mt)=>{if(st.series[0]==y){let bt=b[st.series[1]],gt=e[st.series[1]],$e=(bt._paths||wa).band;zs($e)&&($e=st.dir==1?$e[0]:$e[1]);let Ye,Wt=null;bt.show&&$e&&$b(gt,sn,rn)?(Wt=st.fill(i,Mt)||J,Ye=bt._paths.clip):$e=null,Oe(M,C,L,H,Wt,ae,de,ve,Le,Ue,Ye,$e),Fe=!0}}),Fe||Oe(M,C,L,H,J,ae,de,ve,Le,Ue)}let _n=so|Cf;function Oe(y,M,C,L,H,J,ae,de,ve,Le,Ue,Fe){Ae(y,M,C,L,H),(ve||Le||Fe)&&(h.save(),ve&&h.clip(ve),Le&&h.clip(Le)),Fe?(de&_n)==_n?(h.clip(Fe),Ue&&h.clip(Ue),_t(H,ae),ln(y,J,M)):de&Cf?(_t(H,ae),h.clip(Fe),ln(y,J,M)):de&so&&(h.save(),h.clip(Fe),Ue&&h.clip(Ue),_t(H,ae),h.restore(),ln(y,J,M)):(_t(H,ae),ln(y,J,M)),(ve||Le||Fe)&&h.restore()}function ln(y,M,C){C>0&&(M instanceof Map?M.forEach((L,H)=>{h.strokeStyle=Br=H,h.stroke(L)}):M!=null&&y&&h.stroke(M))}function _t(y,M){M instanceof Map?M.forEach((C,L)=>{h.fillStyle=Ds=L,h.fill(C)}):M!=null&&y&&h.fill(M)}function fs(y,M,C,L){let H=I[y],J;if(L<=0)J=[0,0];else{let ae=H._space=H.space(i,y,M,C,L),de=H._incrs=H.incrs(i,y,M,C,L,ae);J=_M(M,C,de,L,ae)}return H._found=J}function cn(y,M,C,L,H,J,ae,de,ve,Le){let Ue=ae%2/2;S==1&&h.translate(Ue,Ue),Ae(de,ae,ve,Le,de),h.beginPath();let Fe,st,Mt,bt,gt=H+(L==0||L==3?-J:J);C==0?(st=H,bt=gt):(Fe=H,Mt=gt);for(let $e=0;$e<y.length;$e++)M[$e]!=null&&(C==0?Fe=Mt=y[$e]:st=bt=y[$e],h.moveTo(Fe,st),h.lineTo(Mt,bt));h.stroke(),S==1&&h.translate(-Ue,-Ue)}function Gr(y){let M=!0;return I.forEach((C,L)=>{if(!C.show)return;let H=x[C.scale];if(H.min==null){C._show&&(M=!1,C._show=!1,ut(!1));return}else C._show||(M=!1,C._show=!0,ut(!1));let J=C.side,ae=J%2,{min:de,max:ve}=H,[Le,Ue]=fs(L,de,ve,ae==0?O:Ie);if(Ue==0)return;let Fe=H.distr==2,st=C._splits=C.splits(i,L,de,ve,Le,Ue,Fe),Mt=H.distr==2?st.map(Ye=>ii[Ye]):st,bt=H.distr==2?ii[st[1]]-ii[st[0]]:Le,gt=C._values=C.values(i,C.filter(i,Mt,L,Ue,bt),L,Ue,bt);C._rotate=J==2?C.rotate(i,gt,L,Ue):0;let $e=C._size;C._size=bi(C.size(i,gt,L,y)),$e!=null&&C._size!=$e&&(M=!1)}),M}function Ki(y){let M=!0;return na.forEach((C,L)=>{let H=C(i,L,Xi,y);H!=Ri[L]&&(M=!1),Ri[L]=H}),M}function ds(){for(let y=0;y<I.length;y++){let M=I[y];if(!M.show||!M._show)continue;let C=M.side,L=C%2,H,J,ae=M.stroke(i,y),de=C==0||C==3?-1:1,[ve,Le]=M._found;if(M.label!=null){let Xn=M.labelGap*de,oi=yn((M._lpos+Xn)*Et);Pe(M.labelFont[0],ae,"center",C==2?"top":xg),h.save(),L==1?(H=J=0,h.translate(oi,yn(v+ue/2)),h.rotate((C==3?-Ql:Ql)/2)):(H=yn(R+X/2),J=oi);let ur=l0(M.label)?M.label(i,y,ve,Le):M.label;h.fillText(ur,H,J),h.restore()}if(Le==0)continue;let Ue=x[M.scale],Fe=L==0?X:ue,st=L==0?R:v,Mt=M._splits,bt=Ue.distr==2?Mt.map(Xn=>ii[Xn]):Mt,gt=Ue.distr==2?ii[Mt[1]]-ii[Mt[0]]:ve,$e=M.ticks,Ye=M.border,Wt=$e.show?$e.size:0,tn=yn(Wt*Et),Pn=yn((M.alignTo==2?M._size-Wt-M.gap:M.gap)*Et),Ut=M._rotate*-Ql/180,nn=g(M._pos*Et),si=(tn+Pn)*de,Wn=nn+si;J=L==0?Wn:0,H=L==1?Wn:0;let gi=M.font[0],Ii=M.align==1?jr:M.align==2?gf:Ut>0?jr:Ut<0?gf:L==0?"center":C==3?gf:jr,$i=Ut||L==1?"middle":C==2?"top":xg;Pe(gi,ae,Ii,$i);let ri=M.font[1]*M.lineGap,_i=Mt.map(Xn=>g(a(Xn,Ue,Fe,st))),Ci=M._values;for(let Xn=0;Xn<Ci.length;Xn++){let oi=Ci[Xn];if(oi!=null){L==0?H=_i[Xn]:J=_i[Xn],oi=""+oi;let ur=oi.indexOf(`
`)==-1?[oi]:oi.split(/\n/gm);for(let Yn=0;Yn<ur.length;Yn++){let zp=ur[Yn];Ut?(h.save(),h.translate(H,J+Yn*ri),h.rotate(Ut),h.fillText(zp,0,0),h.restore()):h.fillText(zp,H,J+Yn*ri)}}}$e.show&&cn(_i,$e.filter(i,bt,y,Le,gt),L,C,nn,tn,kt($e.width*Et,3),$e.stroke(i,y),$e.dash,$e.cap);let Ji=M.grid;Ji.show&&cn(_i,Ji.filter(i,bt,y,Le,gt),L,L==0?2:1,L==0?v:R,L==0?ue:X,kt(Ji.width*Et,3),Ji.stroke(i,y),Ji.dash,Ji.cap),Ye.show&&cn([nn],[1],L==0?1:0,L==0?1:2,L==1?v:R,L==1?ue:X,kt(Ye.width*Et,3),Ye.stroke(i,y),Ye.dash,Ye.cap)}Cn("drawAxes")}function ut(y){b.forEach((M,C)=>{C>0&&(M._paths=null,y&&(s==1?(M.min=null,M.max=null):M.facets.forEach(L=>{L.min=null,L.max=null})))})}let en=!1,Hn=!1,Lt=[];function un(){Hn=!1;for(let y=0;y<Lt.length;y++)Cn(...Lt[y]);Lt.length=0}function Fn(){en||(uS(Mp),en=!0)}function Cl(y,M=!1){en=!0,Hn=M,y(i),Mp(),M&&Lt.length>0&&queueMicrotask(un)}i.batch=Cl;function Mp(){if(oe&&(dt(),oe=!1),xe&&(Ee(),xe=!1),_e){if(Xt(d,jr,Ze),Xt(d,"top",at),Xt(d,Ma,O),Xt(d,Ea,Ie),Xt(p,jr,Ze),Xt(p,"top",at),Xt(p,Ma,O),Xt(p,Ea,Ie),Xt(f,Ma,jt),Xt(f,Ea,an),u.width=yn(jt*Et),u.height=yn(an*Et),I.forEach(({_el:y,_show:M,_size:C,_pos:L,side:H})=>{if(y!=null)if(M){let J=H===3||H===0?C:0,ae=H%2==1;Xt(y,ae?"left":"top",L-J),Xt(y,ae?"width":"height",C),Xt(y,ae?"top":"left",ae?at:Ze),Xt(y,ae?"height":"width",ae?Ie:O),Tf(y,gr)}else li(y,gr)}),Br=Ds=kr=k=Q=Z=$=Te=E=null,Ce=1,aa(!0),Ze!=Me||at!=Ot||O!=ze||Ie!=Ke){ut(!1);let y=O/ze,M=Ie/Ke;if(me&&!ne&&he.left>=0){he.left*=y,he.top*=M,zr&&es(zr,yn(he.left),0,O,Ie),Vr&&es(Vr,0,yn(he.top),O,Ie);for(let C=0;C<lt.length;C++){let L=lt[C];L!=null&&(zt[C]*=y,Vn[C]*=M,es(L,bi(zt[C]),bi(Vn[C]),O,Ie))}}if(Ht.show&&!se&&Ht.left>=0&&Ht.width>0){Ht.left*=y,Ht.width*=y,Ht.top*=M,Ht.height*=M;for(let C in Ph)Xt(Xr,C,Ht[C])}Me=Ze,Ot=at,ze=O,Ke=Ie}Cn("setSize"),_e=!1}jt>0&&an>0&&(h.clearRect(0,0,u.width,u.height),Cn("drawClear"),T.forEach(y=>y()),Cn("draw")),Ht.show&&se&&(Pl(Ht),se=!1),me&&ne&&(cr(null,!0,!1),ne=!1),fe.show&&fe.live&&pe&&(Ih(),pe=!1),c||(c=!0,i.status=1,Cn("ready")),Ls=!1,en=!1}i.redraw=(y,M)=>{xe=M||!1,y!==!1?Os(A,P.min,P.max):Fn()};function Ah(y,M){let C=x[y];if(C.from==null){if(Qt==0){let L=C.range(i,M.min,M.max,y);M.min=L[0],M.max=L[1]}if(M.min>M.max){let L=M.min;M.min=M.max,M.max=L}if(Qt>1&&M.min!=null&&M.max!=null&&M.max-M.min<1e-16)return;y==A&&C.distr==2&&Qt>0&&(M.min=Ui(M.min,e[0]),M.max=Ui(M.max,e[0]),M.min==M.max&&M.max++),V[y]=M,oe=!0,Fn()}}i.setScale=Ah;let wh,Rh,zr,Vr,Ep,Tp,Hr,Wr,Ap,wp,Vt,Zt,Us=!1,Dn=he.drag,Rn=Dn.x,In=Dn.y;me&&(he.x&&(wh=vi(Db,p)),he.y&&(Rh=vi(Ub,p)),P.ori==0?(zr=wh,Vr=Rh):(zr=Rh,Vr=wh),Vt=he.left,Zt=he.top);let Ht=i.select=fn({show:!0,over:!0,left:0,width:0,top:0,height:0},n.select),Xr=Ht.show?vi(Lb,Ht.over?p:d):null;function Pl(y,M){if(Ht.show){for(let C in y)Ht[C]=y[C],C in Ph&&Xt(Xr,C,y[C]);M!==!1&&Cn("setSelect")}}i.setSelect=Pl;function Bx(y){if(b[y].show)ee&&Tf(ot[y],gr);else if(ee&&li(ot[y],gr),me){let C=Re?lt[0]:lt[y];C!=null&&es(C,-10,-10,O,Ie)}}function Os(y,M,C){Ah(y,{min:M,max:C})}function Zi(y,M,C,L){M.focus!=null&&Hx(y),M.show!=null&&b.forEach((H,J)=>{J>0&&(y==J||y==null)&&(H.show=M.show,Bx(J),s==2?(Os(H.facets[0].scale,null,null),Os(H.facets[1].scale,null,null)):Os(H.scale,null,null),Fn())}),C!==!1&&Cn("setSeries",y,M),L&&la("setSeries",i,y,M)}i.setSeries=Zi;function kx(y,M){fn(w[y],M)}function Gx(y,M){y.fill=yt(y.fill||null),y.dir=St(y.dir,-1),M=M??w.length,w.splice(M,0,y)}function zx(y){y==null?w.length=0:w.splice(y,1)}i.addBand=Gx,i.setBand=kx,i.delBand=zx;function Vx(y,M){b[y].alpha=M,me&&lt[y]!=null&&(lt[y].style.opacity=M),ee&&ot[y]&&(ot[y].style.opacity=M)}let ps,Fs,lr,Yr={focus:!0};function Hx(y){if(y!=lr){let M=y==null,C=Be.alpha!=1;b.forEach((L,H)=>{if(s==1||H>0){let J=M||H==0||H==y;L._focus=M?null:J,C&&Vx(H,J?1:Be.alpha)}}),lr=y,C&&Fn()}}ee&&je&&vt(Mg,we,y=>{he._lock||(Je(y),lr!=null&&Zi(null,Yr,!0,hn.setSeries))});function qi(y,M,C){let L=x[M];C&&(y=y/Et-(L.ori==1?at:Ze));let H=O;L.ori==1&&(H=Ie,y=H-y),L.dir==-1&&(y=H-y);let J=L._min,ae=L._max,de=y/H,ve=J+(ae-J)*de,Le=L.distr;return Le==3?to(10,ve):Le==4?jb(ve,L.asinh):Le==100?L.bwd(ve):ve}function Wx(y,M){let C=qi(y,A,M);return Ui(C,e[0],sn,rn)}i.valToIdx=y=>Ui(y,e[0]),i.posToIdx=Wx,i.posToVal=qi,i.valToPos=(y,M,C)=>x[M].ori==0?r(y,x[M],C?X:O,C?R:0):o(y,x[M],C?ue:Ie,C?v:0),i.setCursor=(y,M,C)=>{Vt=y.left,Zt=y.top,cr(null,M,C)};function Rp(y,M){Xt(Xr,jr,Ht.left=y),Xt(Xr,Ma,Ht.width=M)}function Ip(y,M){Xt(Xr,"top",Ht.top=y),Xt(Xr,Ea,Ht.height=M)}let ra=P.ori==0?Rp:Ip,oa=P.ori==1?Rp:Ip;function Xx(){if(ee&&fe.live)for(let y=s==2?1:0;y<b.length;y++){if(y==0&&ct)continue;let M=fe.values[y],C=0;for(let L in M)Ve[y][C++].firstChild.nodeValue=M[L]}}function Ih(y,M){if(y!=null&&(y.idxs?y.idxs.forEach((C,L)=>{te[L]=C}):nS(y.idx)||te.fill(y.idx),fe.idx=te[0]),ee&&fe.live){for(let C=0;C<b.length;C++)(C>0||s==1&&!ct)&&Yx(C,te[C]);Xx()}pe=!1,M!==!1&&Cn("setLegend")}i.setLegend=Ih;function Yx(y,M){let C=b[y],L=y==0&&B==2?ii:e[y],H;ct?H=C.values(i,y,M)??it:(H=C.value(i,M==null?null:L[M],y,M),H=H==null?it:{_:H}),fe.values[y]=H}function cr(y,M,C){Ap=Vt,wp=Zt,[Vt,Zt]=he.move(i,Vt,Zt),he.left=Vt,he.top=Zt,me&&(zr&&es(zr,yn(Vt),0,O,Ie),Vr&&es(Vr,0,yn(Zt),O,Ie));let L,H=sn>rn;ps=Bt,Fs=null;let J=P.ori==0?O:Ie,ae=P.ori==1?O:Ie;if(Vt<0||Qt==0||H){L=he.idx=null;for(let de=0;de<b.length;de++){let ve=lt[de];ve!=null&&es(ve,-10,-10,O,Ie)}je&&Zi(null,Yr,!0,y==null&&hn.setSeries),fe.live&&(te.fill(L),pe=!0)}else{let de,ve,Le;s==1&&(de=P.ori==0?Vt:Zt,ve=qi(de,A),L=he.idx=Ui(ve,e[0],sn,rn),Le=G(e[0][L],P,J,0));let Ue=-10,Fe=-10,st=0,Mt=0,bt=!0,gt="",$e="";for(let Ye=s==2?1:0;Ye<b.length;Ye++){let Wt=b[Ye],tn=te[Ye],Pn=tn==null?null:s==1?e[Ye][tn]:e[Ye][1][tn],Ut=he.dataIdx(i,Ye,L,ve),nn=Ut==null?null:s==1?e[Ye][Ut]:e[Ye][1][Ut];if(pe=pe||nn!=Pn||Ut!=tn,te[Ye]=Ut,Ye>0&&Wt.show){let si=Ut==null?-10:Ut==L?Le:G(s==1?e[0][Ut]:e[Ye][0][Ut],P,J,0),Wn=nn==null?-10:N(nn,s==1?x[Wt.scale]:x[Wt.facets[1].scale],ae,0);if(je&&nn!=null){let gi=P.ori==1?Vt:Zt,Ii=xn(Be.dist(i,Ye,Ut,Wn,gi));if(Ii<ps){let $i=Be.bias;if($i!=0){let ri=qi(gi,Wt.scale),_i=nn>=0?1:-1,Ci=ri>=0?1:-1;Ci==_i&&(Ci==1?$i==1?nn>=ri:nn<=ri:$i==1?nn<=ri:nn>=ri)&&(ps=Ii,Fs=Ye)}else ps=Ii,Fs=Ye}}if(pe||Re){let gi,Ii;P.ori==0?(gi=si,Ii=Wn):(gi=Wn,Ii=si);let $i,ri,_i,Ci,Ji,Xn,oi=!0,ur=ce.bbox;if(ur!=null){oi=!1;let Yn=ur(i,Ye);_i=Yn.left,Ci=Yn.top,$i=Yn.width,ri=Yn.height}else _i=gi,Ci=Ii,$i=ri=ce.size(i,Ye);if(Xn=ce.fill(i,Ye),Ji=ce.stroke(i,Ye),Re)Ye==Fs&&ps<=Be.prox&&(Ue=_i,Fe=Ci,st=$i,Mt=ri,bt=oi,gt=Xn,$e=Ji);else{let Yn=lt[Ye];Yn!=null&&(zt[Ye]=_i,Vn[Ye]=Ci,Cg(Yn,$i,ri,oi),Rg(Yn,Xn,Ji),es(Yn,bi(_i),bi(Ci),O,Ie))}}}}if(Re){let Ye=Be.prox,Wt=lr==null?ps<=Ye:ps>Ye||Fs!=lr;if(pe||Wt){let tn=lt[0];tn!=null&&(zt[0]=Ue,Vn[0]=Fe,Cg(tn,st,Mt,bt),Rg(tn,gt,$e),es(tn,bi(Ue),bi(Fe),O,Ie))}}}if(Ht.show&&Us)if(y!=null){let[de,ve]=hn.scales,[Le,Ue]=hn.match,[Fe,st]=y.cursor.sync.scales,Mt=y.cursor.drag;if(Rn=Mt._x,In=Mt._y,Rn||In){let{left:bt,top:gt,width:$e,height:Ye}=y.select,Wt=y.scales[Fe].ori,tn=y.posToVal,Pn,Ut,nn,si,Wn,gi=de!=null&&Le(de,Fe),Ii=ve!=null&&Ue(ve,st);gi&&Rn?(Wt==0?(Pn=bt,Ut=$e):(Pn=gt,Ut=Ye),nn=x[de],si=G(tn(Pn,Fe),nn,J,0),Wn=G(tn(Pn+Ut,Fe),nn,J,0),ra(Oi(si,Wn),xn(Wn-si))):ra(0,J),Ii&&In?(Wt==1?(Pn=bt,Ut=$e):(Pn=gt,Ut=Ye),nn=x[ve],si=N(tn(Pn,st),nn,ae,0),Wn=N(tn(Pn+Ut,st),nn,ae,0),oa(Oi(si,Wn),xn(Wn-si))):oa(0,ae)}else Nh()}else{let de=xn(Ap-Ep),ve=xn(wp-Tp);if(P.ori==1){let st=de;de=ve,ve=st}Rn=Dn.x&&de>=Dn.dist,In=Dn.y&&ve>=Dn.dist;let Le=Dn.uni;Le!=null?Rn&&In&&(Rn=de>=Le,In=ve>=Le,!Rn&&!In&&(ve>de?In=!0:Rn=!0)):Dn.x&&Dn.y&&(Rn||In)&&(Rn=In=!0);let Ue,Fe;Rn&&(P.ori==0?(Ue=Hr,Fe=Vt):(Ue=Wr,Fe=Zt),ra(Oi(Ue,Fe),xn(Fe-Ue)),In||oa(0,ae)),In&&(P.ori==1?(Ue=Hr,Fe=Vt):(Ue=Wr,Fe=Zt),oa(Oi(Ue,Fe),xn(Fe-Ue)),Rn||ra(0,J)),!Rn&&!In&&(ra(0,0),oa(0,0))}if(Dn._x=Rn,Dn._y=In,y==null){if(C){if(Gp!=null){let[de,ve]=hn.scales;hn.values[0]=de!=null?qi(P.ori==0?Vt:Zt,de):null,hn.values[1]=ve!=null?qi(P.ori==1?Vt:Zt,ve):null}la(_f,i,Vt,Zt,O,Ie,L)}if(je){let de=C&&hn.setSeries,ve=Be.prox;lr==null?ps<=ve&&Zi(Fs,Yr,!0,de):ps>ve?Zi(null,Yr,!0,de):Fs!=lr&&Zi(Fs,Yr,!0,de)}}pe&&(fe.idx=L,Ih()),M!==!1&&Cn("setCursor")}let Bs=null;Object.defineProperty(i,"rect",{get(){return Bs==null&&aa(!1),Bs}});function aa(y=!1){y?Bs=null:(Bs=p.getBoundingClientRect(),Cn("syncRect",Bs))}function Cp(y,M,C,L,H,J,ae){he._lock||Us&&y!=null&&y.movementX==0&&y.movementY==0||(Ch(y,M,C,L,H,J,ae,!1,y!=null),y!=null?cr(null,!0,!0):cr(M,!0,!1))}function Ch(y,M,C,L,H,J,ae,de,ve){if(Bs==null&&aa(!1),Je(y),y!=null)C=y.clientX-Bs.left,L=y.clientY-Bs.top;else{if(C<0||L<0){Vt=-10,Zt=-10;return}let[Le,Ue]=hn.scales,Fe=M.cursor.sync,[st,Mt]=Fe.values,[bt,gt]=Fe.scales,[$e,Ye]=hn.match,Wt=M.axes[0].side%2==1,tn=P.ori==0?O:Ie,Pn=P.ori==1?O:Ie,Ut=Wt?J:H,nn=Wt?H:J,si=Wt?L:C,Wn=Wt?C:L;if(bt!=null?C=$e(Le,bt)?a(st,x[Le],tn,0):-10:C=tn*(si/Ut),gt!=null?L=Ye(Ue,gt)?a(Mt,x[Ue],Pn,0):-10:L=Pn*(Wn/nn),P.ori==1){let gi=C;C=L,L=gi}}ve&&(M==null||M.cursor.event.type==_f)&&((C<=1||C>=O-1)&&(C=pr(C,O)),(L<=1||L>=Ie-1)&&(L=pr(L,Ie))),de?(Ep=C,Tp=L,[Hr,Wr]=he.move(i,C,L)):(Vt=C,Zt=L)}let Ph={width:0,height:0,left:0,top:0};function Nh(){Pl(Ph,!1)}let Pp,Np,Lp,Dp;function Up(y,M,C,L,H,J,ae){Us=!0,Rn=In=Dn._x=Dn._y=!1,Ch(y,M,C,L,H,J,ae,!0,!1),y!=null&&(vt(yf,Mf,Op,!1),la(bg,i,Hr,Wr,O,Ie,null));let{left:de,top:ve,width:Le,height:Ue}=Ht;Pp=de,Np=ve,Lp=Le,Dp=Ue}function Op(y,M,C,L,H,J,ae){Us=Dn._x=Dn._y=!1,Ch(y,M,C,L,H,J,ae,!1,!0);let{left:de,top:ve,width:Le,height:Ue}=Ht,Fe=Le>0||Ue>0,st=Pp!=de||Np!=ve||Lp!=Le||Dp!=Ue;if(Fe&&st&&Pl(Ht),Dn.setScale&&Fe&&st){let Mt=de,bt=Le,gt=ve,$e=Ue;if(P.ori==1&&(Mt=ve,bt=Ue,gt=de,$e=Le),Rn&&Os(A,qi(Mt,A),qi(Mt+bt,A)),In)for(let Ye in x){let Wt=x[Ye];Ye!=A&&Wt.from==null&&Wt.min!=Bt&&Os(Ye,qi(gt+$e,Ye),qi(gt,Ye))}Nh()}else he.lock&&(he._lock=!he._lock,cr(M,!0,y!=null));y!=null&&(gn(yf,Mf),la(yf,i,Vt,Zt,O,Ie,null))}function Kx(y,M,C,L,H,J,ae){if(he._lock)return;Je(y);let de=Us;if(Us){let ve=!0,Le=!0,Ue=10,Fe,st;P.ori==0?(Fe=Rn,st=In):(Fe=In,st=Rn),Fe&&st&&(ve=Vt<=Ue||Vt>=O-Ue,Le=Zt<=Ue||Zt>=Ie-Ue),Fe&&ve&&(Vt=Vt<Hr?0:O),st&&Le&&(Zt=Zt<Wr?0:Ie),cr(null,!0,!0),Us=!1}Vt=-10,Zt=-10,te.fill(null),cr(null,!0,!0),de&&(Us=de)}function Fp(y,M,C,L,H,J,ae){he._lock||(Je(y),sa(),Nh(),y!=null&&la(Eg,i,Vt,Zt,O,Ie,null))}function Bp(){I.forEach(yM),U(i.width,i.height,!0)}_r(ec,eo,Bp);let Kr={};Kr.mousedown=Up,Kr.mousemove=Cp,Kr.mouseup=Op,Kr.dblclick=Fp,Kr.setSeries=(y,M,C,L)=>{let H=hn.match[2];C=H(i,M,C),C!=-1&&Zi(C,L,!0,!1)},me&&(vt(bg,p,Up),vt(_f,p,Cp),vt(Sg,p,y=>{Je(y),aa(!1)}),vt(Mg,p,Kx),vt(Eg,p,Fp),Pf.add(i),i.syncRect=aa);let Nl=i.hooks=n.hooks||{};function Cn(y,M,C){Hn?Lt.push([y,M,C]):y in Nl&&Nl[y].forEach(L=>{L.call(null,i,M,C)})}(n.plugins||[]).forEach(y=>{for(let M in y.hooks)Nl[M]=(Nl[M]||[]).concat(y.hooks[M])});let kp=(y,M,C)=>C,hn=fn({key:null,setSeries:!1,filters:{pub:Ug,sub:Ug},scales:[A,b[1]?b[1].scale:null],match:[Og,Og,kp],values:[null,null]},he.sync);hn.match.length==2&&hn.match.push(kp),he.sync=hn;let Gp=hn.key,Lh=N0(Gp);function la(y,M,C,L,H,J,ae){hn.filters.pub(y,M,C,L,H,J,ae)&&Lh.pub(y,M,C,L,H,J,ae)}Lh.sub(i);function Zx(y,M,C,L,H,J,ae){hn.filters.sub(y,M,C,L,H,J,ae)&&Kr[y](null,M,C,L,H,J,ae)}i.pub=Zx;function qx(){Lh.unsub(i),Pf.delete(i),wn.clear(),Af(ec,eo,Bp),l.remove(),we?.remove(),Cn("destroy")}i.destroy=qx;function Dh(){Cn("init",n,e),ia(e||n.data,!1),V[A]?Ah(A,V[A]):sa(),se=Ht.show&&(Ht.width>0||Ht.height>0),ne=pe=!0,U(n.width,n.height)}return b.forEach(Fr),I.forEach(us),t?t instanceof HTMLElement?(t.appendChild(l),Dh()):t(i,Dh):Dh(),i}dn.assign=fn;dn.fmtNum=Bf;dn.rangeNum=tc;dn.rangeLog=sc;dn.rangeAsinh=Of;dn.orient=xr;dn.pxRatio=Et;dn.join=cS;dn.fmtDate=Gf,dn.tzDate=vS;dn.sync=N0;{dn.addGap=nM,dn.clipGaps=ac;let n=dn.paths={points:B0};n.linear=G0,n.stepped=rM,n.bars=oM,n.spline=lM}function De(n){let e=document.getElementById(n);if(e===null)throw new Error(`index.html has no element ${n}`);return e}var ei=n=>De(n),Un=n=>De(n);function Jt(n,e){n.textContent!==e&&(n.textContent=e)}function tt(n,e="",...t){let i=document.createElement(n);return i.className=e,i.append(...t),i}function lo(n,e=n){let t=tt("option","",e);return t.value=n,t}function co(n){return getComputedStyle(document.documentElement).getPropertyValue(`--${n}`).trim()}var Ia=n=>n.ariaPressed==="true",Hs=(n,e)=>n.ariaPressed=String(e);function uo(n){addEventListener("keydown",e=>{if(e.ctrlKey||e.metaKey||e.altKey||document.querySelector("dialog[open]")!==null)return;let t=e.target instanceof HTMLElement?e.target.tagName:"";t==="SELECT"||t==="INPUT"&&/^(Arrow|\d| )/.test(e.key)||e.key===" "&&(t==="BUTTON"||t==="SUMMARY")||n(e.key.length===1?e.key.toLowerCase():e.key,e)}),addEventListener("click",e=>{e.detail>0&&e.target.closest("button, summary")?.blur()})}function xM([n,e],t){let i=n.flatMap((r,o)=>e[o]==null?[]:{at:r,value:e[o]}),s=0;return t.map(r=>{for(;s<i.length&&i[s].at<r;)s+=1;let[o,a]=[i[s-1],i[s]];if(a?.at===r)return a.value;if(!(o===void 0||a===void 0))return o.value+(r-o.at)/(a.at-o.at)*(a.value-o.value)})}function W0(n){let e=[...new Set(n.flatMap(([o,a])=>o.filter((c,l)=>a[l]!=null)))];e.sort((o,a)=>o-a);let t=n.map(o=>xM(o,e)),i=e.map((o,a)=>t.flatMap(c=>c[a]??[])),s=o=>o.reduce((a,c)=>a+c,0)/o.length,r=[o=>Math.max(...o),o=>Math.min(...o)];return[e,i.map(s),i.map(r[0]),i.map(r[1])]}function X0(n){let[e="",...t]=n,i=e.length;for(;!t.every(s=>s.startsWith(e.slice(0,i)));)i-=1;return e.slice(0,i).replace(/[-_.,:/\s]+$/,"")||e}var Kf=["rollout/fall_fraction","rollout/ep_len_mean","time/fps"],vM=["rollout/ep_rew_mean","rollout/distance_mean_m",...Kf],bM=["rollout/ep_rew_mean","eval/velocity_error","eval/yaw_rate_error",...Kf],SM=["rollout/ep_rew_mean","eval/done_share","eval/body_error",...Kf],MM=new Map([["rewards/track_linear_velocity",bM],["rewards/motion_body_pos",SM]]),Y0=new Map([["rollout/ep_rew_mean","eval/mean_reward"],["rollout/distance_mean_m","eval/distance_mean_m"]]),EM="time/resumes",K0=["#2f7bf6","#f2762e","#2bb24c","#b455e0","#e5383b","#18a5b5","#e5a900","#e0529c"],Z0=110,q0=3e3;function TM(n){if(n.values.length<q0)return;let e=(t,i)=>i%2===0||i>q0-200;n.steps=n.steps.filter(e),n.wall_s=n.wall_s.filter(e),n.values=n.values.filter(e)}function Si(n){let e=[[1e12,"T"],[1e9,"G"],[1e6,"M"],[1e3,"k"]],[t,i]=e.find(([s])=>Math.abs(n)>=s)??[1,""];return`${Number((n/t).toPrecision(3))}${i}`}function Zf(n){return n<120?`${Si(n)} s`:n<7200?`${Si(n/60)} min`:`${Si(n/3600)} h`}function qf(n,e){let i={stroke:()=>co("faint"),grid:{stroke:()=>co("border"),width:1},ticks:{show:!1},font:"10px system-ui",gap:3};return[{...i,size:18,space:56,values:(s,r)=>r.map(n)},{...i,size:38,space:e,values:(s,r)=>r.map(Si)}]}var hc=class{curves=new Map;charts=new Map;runs=new Map;added=[];changed=!1;constructor(){Un("tag").addEventListener("change",()=>{this.added.push(Un("tag").value),this.changed=!0});for(let e of[De("axis"),De("seeds")])e.addEventListener("click",()=>{Hs(e,!Ia(e)),this.clear()})}restart(){this.curves.clear(),this.runs.clear()}get bands(){return this.charts.size*this.lines().filter(({runs:e})=>e.length>1).length}newest(e,t){return this.curves.get(t)?.get(e)?.values.findLast(i=>i!==null)??void 0}add(e){for(let{run:t,group:i,tag:s,steps:r,wallS:o,values:a}of e.curves){this.runs.get(t)!==i&&(this.runs.set(t,i),this.clear());let c=this.curves.get(s)??new Map,l=c.get(t)??{steps:[],wall_s:[],values:[]};for(let[u,h]of a.entries())l.steps.push(r[u]),l.wall_s.push(o[u]),l.values.push(Number.isFinite(h)?h:null);TM(l),l.values.length>0&&this.curves.set(s,c.set(t,l))}this.changed=!0}update(){let e=({plot:t,box:i})=>i.clientWidth>0&&i.clientWidth!==t.width;return(this.changed||[...this.charts.values()].some(e))&&this.layOut(),this.changed=!1,this.curves.size>0}clear(){for(let{plot:e}of this.charts.values())e.destroy();De("charts").replaceChildren(),this.charts.clear(),this.changed=!0}layOut(){let e=[...this.curves.keys()],[,t]=[...MM].find(([l])=>this.curves.has(l))??["",vM],i=t.filter(l=>this.curves.has(l)),s=i.length>0?i:e.slice(0,t.length),r=[...new Set([...s,...this.added])].filter(l=>this.curves.has(l)),o=e.filter(l=>!r.includes(l)).sort();Un("tag").options.length!==o.length+1&&(Un("tag").replaceChildren(lo("","Add a curve …"),...o.map(l=>lo(l))),Un("tag").options[0].disabled=!0);let a=[...this.runs.values()].filter(l=>l!=="");De("seeds").hidden=new Set(a).size===a.length;let c=this.lines().map(({name:l,runs:u,colour:h})=>{let f=tt("i",u.length>1?"wide":"");return f.style.background=h,tt("span","",f,l)});De("runs").replaceChildren(...c);for(let l of r)this.fill(l)}lines(){let e=new Map;for(let[t,[i,s]]of[...this.runs].entries()){let o=s!==""&&Ia(De("seeds"))?`group ${s}`:`run ${i}`,a=e.get(o)??{name:i,runs:[],colour:K0[t%K0.length]};a.runs.push(i),a.runs.length>1&&(a.name=`${X0(a.runs)} · ${a.runs.length} seeds`),e.set(o,a)}return[...e.values()]}curve(e,t=""){let i=this.curves.get(t)?.get(e);return[(Ia(De("axis"))?i?.wall_s:i?.steps)??[],i?.values??[]]}fill(e){let t=this.lines(),i=this.charts.get(e)??this.make(e,t),{plot:s,box:r,value:o,resumes:a}=i,c=Y0.get(e),l=[],u=[];a.length=0;for(let{runs:d,colour:p}of t){let S=d.map(b=>this.curve(b,e)),g=d.length>1?W0(S):S[0];l.push(g);let m=g[1].findLast(b=>b!==null);u.push(m==null?"–":Si(m));for(let b of d){c!==void 0&&l.push(this.curve(b,c));let[I,x]=this.curve(b,EM),w=(A,_)=>_>0&&(x[_]??0)>(x[_-1]??0);a.push(...I.filter(w).map(A=>({x:A,colour:p})))}}r.clientWidth>0&&s.setSize({width:r.clientWidth,height:Z0}),s.setData(dn.join(l));let h=t.map(({runs:d})=>{let p=d.flatMap(S=>this.newest(S,c??"")??[]);return p.length===0?"–":Si(p.reduce((S,g)=>S+g)/p.length)}),f=h.some(d=>d!=="–");Jt(o,u.join(" · ")+(f?`, evaluated ● ${h.join(" · ")}`:""))}make(e,t){let i=tt("b"),s=tt("div","plot",tt("p","caption",`${e} `,i));De("charts").append(s);let r=[],o=[{}],a=[];for(let{runs:u,colour:h}of t){let f={stroke:h,spanGaps:!0,points:{show:!1}};o.push({...f,width:u.length>1?2.5:1.5}),u.length>1&&(a.push({series:[o.length,o.length+1],fill:`${h}55`}),o.push({...f,width:0},{...f,width:0}));let d={stroke:h,paths:()=>null,points:{show:!0,size:6,fill:h}};Y0.has(e)&&o.push(...u.map(()=>d))}let c={width:s.clientWidth||240,height:Z0,padding:[6,10,0,0],series:o,bands:a,axes:qf(Ia(De("axis"))?Zf:Si,22),cursor:{y:!1,drag:{x:!1,y:!1}},scales:{x:{time:!1}},hooks:{drawAxes:[u=>AM(u,r)]}},l={plot:new dn(c,[[],...o.slice(1).map(()=>[])],s),box:s,value:i,resumes:r};return this.charts.set(e,l),l}};function AM({ctx:n,bbox:e,valToPos:t},i){n.save(),n.lineWidth=devicePixelRatio,n.setLineDash([3*devicePixelRatio,3*devicePixelRatio]);for(let{x:s,colour:r}of i){let o=t(s,"x",!0);o<e.left||o>e.left+e.width||(n.strokeStyle=r,n.beginPath(),n.moveTo(o,e.top),n.lineTo(o,e.top+e.height),n.stroke())}n.restore()}var fc=Qi("Cgxwb2xpY3kucHJvdG8SDHRyZWFkbWlsbC52MSJDCg1Qb2xpY3lWZXJzaW9uEhMKC2luY2FybmF0aW9uGAEgASgEEg4KBm51bWJlchgCIAEoBBINCgVlcG9jaBgDIAEoBCJsChJQb2xpY3lBbm5vdW5jZW1lbnQSLAoHdmVyc2lvbhgBIAEoCzIbLnRyZWFkbWlsbC52MS5Qb2xpY3lWZXJzaW9uEhAKCGNoZWNrc3VtGAIgASgEEhYKDmFjdG9yX2NoZWNrc3VtGAMgASgEIpABCg1Qb2xpY3lSZXF1ZXN0EioKBWtub3duGAEgASgLMhsudHJlYWRtaWxsLnYxLlBvbGljeVZlcnNpb24SLgoJYW5ub3VuY2VkGAIgASgLMhsudHJlYWRtaWxsLnYxLlBvbGljeVZlcnNpb24SEwoLY29uZmlnX2hhc2gYAyABKAQSDgoGb2Zmc2V0GAQgASgEInsKC1BvbGljeVBpZWNlEgsKA3J1bhgBIAEoCRIsCgd2ZXJzaW9uGAIgASgLMhsudHJlYWRtaWxsLnYxLlBvbGljeVZlcnNpb24SEwoLdG90YWxfYnl0ZXMYAyABKAQSDgoGb2Zmc2V0GAQgASgEEgwKBGRhdGEYBSABKAwihwUKDFBvbGljeUJ1bmRsZRILCgNydW4YASABKAkSLAoHdmVyc2lvbhgCIAEoCzIbLnRyZWFkbWlsbC52MS5Qb2xpY3lWZXJzaW9uEhgKEG9ic2VydmF0aW9uX3NpemUYAyABKA0SEwoLYWN0aW9uX3NpemUYBCABKA0SDgoGaGlkZGVuGAUgAygNEg8KB3dlaWdodHMYBiABKAwSGAoQb2JzZXJ2YXRpb25fbWVhbhgHIAEoDBIfChdvYnNlcnZhdGlvbl9pbnZlcnNlX3N0ZBgIIAEoDBIYChBvYnNlcnZhdGlvbl9jbGlwGAkgASgCEhMKC2NvbmZpZ19oYXNoGAogASgEEhMKC2NvbmZpZ190b21sGAsgASgJEhEKCW1vZGVsX3htbBgMIAEoCRIQCghjaGVja3N1bRgNIAEoBBItCgthY3Rvcl9zdGF0ZRgOIAEoCzIYLnRyZWFkbWlsbC52MS5BY3RvclN0YXRlEhYKDmZyYWdtZW50X3N0ZXBzGA8gASgNEhQKDHdpcmVfdmVyc2lvbhgQIAEoDRIYChB3aXJlX3ZlcnNpb25fbWluGBEgASgNEhcKD3BoeXNpY3NfdmVyc2lvbhgSIAEoDRIXCg9wcml2aWxlZ2VkX3NpemUYEyABKA0SGgoSb2JzZXJ2YXRpb25fbWlycm9yGBQgAygREhUKDWFjdGlvbl9taXJyb3IYFSADKBESGAoQY3VycmljdWx1bV9raW5kcxgWIAMoDRIZChFjdXJyaWN1bHVtX2xldmVscxgXIAMoDRIaChJjdXJyaWN1bHVtX2ZhY3RvcnMYGCADKAISGwoTY3VycmljdWx1bV9mYWlsdXJlcxgZIAMoDSL3AQoKQWN0b3JTdGF0ZRINCgVhY3RvchgBIAEoCRINCgVzdGFydBgCIAEoBBINCgVub2lzZRgDIAMoBhIQCghlcGlzb2RlcxgEIAMoBhIPCgdsZW5ndGhzGAUgAygHEhAKCHByb2dyZXNzGAYgAygBEhEKCXBvc2l0aW9ucxgHIAMoARISCgp2ZWxvY2l0aWVzGAggAygBEhQKDG9ic2VydmF0aW9ucxgJIAMoAhIUCgxwYXN0X2FjdGlvbnMYCiADKAISFQoNc3RlcHNfdG9fcHVzaBgLIAMoBxIPCgdzdHJlYW1zGAwgAygGEgwKBHRhc2sYDSADKAFiBnByb3RvMw");var $0=Qi("Cgpwb29sLnByb3RvEgx0cmVhZG1pbGwudjEi7wEKClBvb2xEZW1hbmQSCwoDcnVuGAEgASgJEg0KBXNoYXJlGAIgASgBEhAKCGVudnNfbWluGAMgASgNEhAKCGVudnNfbWF4GAQgASgNEhAKCGVudnNfb3duGAUgASgNEgwKBGVudnMYBiABKA0SEwoLZW52c190YXJnZXQYByABKA0SDAoEb3BlbhgIIAEoCBIXCg9waHlzaWNzX3ZlcnNpb24YCSABKA0SDQoFZXBvY2gYCiABKAQSDgoGYWN0b3JzGAsgASgNEhMKC3Bvb2xfYWN0b3JzGAwgASgNEhEKCXBvb2xfZW52cxgNIAEoDSIqCghQb29sSm9pbhIMCgRlbnZzGAEgASgNEhAKCHN0cmFuZGVkGAIgASgIIh4KClBvb2xBbnN3ZXISEAoIYWRtaXR0ZWQYASABKAhiBnByb3RvMw");var J0=Qi("CgtzdGF0cy5wcm90bxIMdHJlYWRtaWxsLnYxIuADCgpBY3RvclN0YXRzEg0KBWFjdG9yGAEgASgJEhMKC2luY2FybmF0aW9uGAIgASgEEgwKBGhvc3QYAyABKAkSCwoDcGlkGAQgASgNEiwKB3ZlcnNpb24YBSABKAsyGy50cmVhZG1pbGwudjEuUG9saWN5VmVyc2lvbhIMCgRlbnZzGAYgASgNEhcKD2Vudl9zdGVwc19wZXJfcxgHIAEoARIRCgllbnZfc3RlcHMYCCABKAQSEAoIZXBpc29kZXMYCSABKAQSDgoGZmF1bHRzGAogASgEEhAKCHByb2R1Y2VkGAsgASgEEhAKCGFjY2VwdGVkGAwgASgEEhcKD2Ryb3BwZWRfYnlfcnVsZRgNIAEoBBIRCglpbl9mbGlnaHQYDiABKAQSDgoGcmVzZW50GA8gASgEEhsKE2F3YWl0aW5nX2R1cmFiaWxpdHkYECABKAQSFgoOcmVzaWRlbnRfYnl0ZXMYESABKAQSFwoPcHJvZ3JhbV92ZXJzaW9uGBIgASgJEh4KFnNpbXVsYXRpb25fc3RlcHNfcGVyX3MYEyABKAESHQoVaW5mZXJlbmNlX3N0ZXBzX3Blcl9zGBQgASgBEhwKFGVuY29kaW5nX3N0ZXBzX3Blcl9zGBUgASgBYgZwcm90bzM",[fc]);var j0=Qi("Cg1jb250cm9sLnByb3RvEgx0cmVhZG1pbGwudjEiVAoOQ29udHJvbFJlcXVlc3QSJgoHY29tbWFuZBgBIAEoDjIVLnRyZWFkbWlsbC52MS5Db21tYW5kEgsKA2tleRgCIAEoCRINCgV2YWx1ZRgDIAEoCSJTCgxDb250cm9sUmVwbHkSDAoEZG9uZRgBIAEoCBIMCgR0ZXh0GAIgASgJEicKBnN0YXR1cxgDIAEoCzIXLnRyZWFkbWlsbC52MS5SdW5TdGF0dXMi4wkKCVJ1blN0YXR1cxILCgNydW4YASABKAkSIgoFcGhhc2UYAiABKA4yEy50cmVhZG1pbGwudjEuUGhhc2USLAoHdmVyc2lvbhgDIAEoCzIbLnRyZWFkbWlsbC52MS5Qb2xpY3lWZXJzaW9uEgwKBGhvc3QYBCABKAkSCwoDcGlkGAUgASgNEhcKD3Byb2dyYW1fdmVyc2lvbhgGIAEoCRIRCgllbnZfc3RlcHMYByABKAQSGAoQZW52X3N0ZXBzX3dhbnRlZBgIIAEoBBIPCgd1cGRhdGVzGAkgASgEEg4KBndhbGxfcxgKIAEoARIXCg9lbnZfc3RlcHNfcGVyX3MYCyABKAESFgoOc2luY2VfdXBkYXRlX3MYDCABKAESGAoLcmV0dXJuX21lYW4YDSABKAFIAIgBARIYCgtsZW5ndGhfbWVhbhgOIAEoAUgBiAEBEhwKD2Rpc3RhbmNlX21lYW5fbRgPIAEoAUgCiAEBEh4KEXZlbG9jaXR5X21lYW5fbXBzGBAgASgBSAOIAQESFwoPcG9saWN5X2xhZ19tZWFuGBEgASgBEhYKDnJlc2lkZW50X2J5dGVzGBIgASgEEhAKCGFjY2VwdGVkGBMgASgEEhEKCWR1cGxpY2F0ZRgUIAEoBBIPCgd0b29fb2xkGBUgASgEEhAKCHZhbmlzaGVkGBYgASgEEhEKCW1hbGZvcm1lZBgXIAEoBBITCgtxdWFyYW50aW5lZBgYIAEoBBIpCgZhY3RvcnMYGSADKAsyGS50cmVhZG1pbGwudjEuQWN0b3JTdGF0dXMSEwoLdGltZV91bml4X3MYGiABKAESFgoOYWNjZXB0ZWRfYnl0ZXMYGyABKAQSFwoKdXNlZF9zaGFyZRgcIAEoAUgEiAEBEhcKCmlkbGVfc2hhcmUYHSABKAFIBYgBARIWCg51bmRvbmVfdXBkYXRlcxgeIAEoBBIOCgZhbGFybXMYHyADKAkSGQoRd2FpdHNfZm9yX3N0b3JhZ2UYICABKAgSDQoFbGltaXQYISABKAkSEgoKbGltaXRfaGVscBgiIAEoCRIUCgxoYXNfY29tbWFuZHMYIyABKAgSHwoSdmVsb2NpdHlfZXJyb3JfbXBzGCQgASgBSAaIAQESIQoUeWF3X3JhdGVfZXJyb3JfcmFkcHMYJSABKAFIB4gBARIaCg1mYWxsX2ZyYWN0aW9uGCYgASgBSAiIAQESJQoFcGFydHMYJyADKAsyFi50cmVhZG1pbGwudjEuUGFydFRpbWUSJgoEcG9vbBgoIAEoCzIYLnRyZWFkbWlsbC52MS5Qb29sRGVtYW5kEhcKCmRvbmVfc2hhcmUYKSABKAFICYgBARIZCgxib2R5X2Vycm9yX20YKiABKAFICogBAUIOCgxfcmV0dXJuX21lYW5CDgoMX2xlbmd0aF9tZWFuQhIKEF9kaXN0YW5jZV9tZWFuX21CFAoSX3ZlbG9jaXR5X21lYW5fbXBzQg0KC191c2VkX3NoYXJlQg0KC19pZGxlX3NoYXJlQhUKE192ZWxvY2l0eV9lcnJvcl9tcHNCFwoVX3lhd19yYXRlX2Vycm9yX3JhZHBzQhAKDl9mYWxsX2ZyYWN0aW9uQg0KC19kb25lX3NoYXJlQg8KDV9ib2R5X2Vycm9yX20iJwoIUGFydFRpbWUSDAoEbmFtZRgBIAEoCRINCgVzaGFyZRgCIAEoASLGAQoLQWN0b3JTdGF0dXMSDAoEbmFtZRgBIAEoCRINCgVhbGl2ZRgCIAEoCBIcCg9zaW5jZV9jb250YWN0X3MYAyABKAFIAIgBARITCgtxdWFyYW50aW5lZBgEIAEoCBIZCgxsYWdfdmVyc2lvbnMYBSABKARIAYgBARInCgVzdGF0cxgGIAEoCzIYLnRyZWFkbWlsbC52MS5BY3RvclN0YXRzQhIKEF9zaW5jZV9jb250YWN0X3NCDwoNX2xhZ192ZXJzaW9ucyqYAQoHQ29tbWFuZBIXChNDT01NQU5EX1VOU1BFQ0lGSUVEEAASEgoOQ09NTUFORF9TVEFUVVMQARIRCg1DT01NQU5EX1BBVVNFEAISEgoOQ09NTUFORF9SRVNVTUUQAxIWChJDT01NQU5EX0NIRUNLUE9JTlQQBBIQCgxDT01NQU5EX1NUT1AQBRIPCgtDT01NQU5EX1NFVBAGKlgKBVBoYXNlEhUKEVBIQVNFX1VOU1BFQ0lGSUVEEAASEgoOUEhBU0VfVFJBSU5JTkcQARIQCgxQSEFTRV9QQVVTRUQQAhISCg5QSEFTRV9TVE9QUElORxADYgZwcm90bzM",[fc,$0,J0]);var $f=(s=>(s[s.UNSPECIFIED=0]="UNSPECIFIED",s[s.TRAINING=1]="TRAINING",s[s.PAUSED=2]="PAUSED",s[s.STOPPING=3]="STOPPING",s))($f||{});var Jf=Qi("CgpwYWdlLnByb3RvEgx0cmVhZG1pbGwudjEi/AEKBlRvUGFnZRIoCgVzY2VuZRgBIAEoCzIXLnRyZWFkbWlsbC52MS5QYWdlU2NlbmVIABIoCgVmcmFtZRgCIAEoCzIXLnRyZWFkbWlsbC52MS5QYWdlRnJhbWVIABIqCgZjdXJ2ZXMYAyABKAsyGC50cmVhZG1pbGwudjEuUGFnZUN1cnZlc0gAEhAKBm5vdGljZRgEIAEoCUgAEioKBnN0YXR1cxgFIAEoCzIYLnRyZWFkbWlsbC52MS5QYWdlU3RhdHVzSAASLAoHc3RlZXJlchgGIAEoDjIZLnRyZWFkbWlsbC52MS5QYWdlU3RlZXJlckgAQgYKBGtpbmQiVAoKUGFnZVN0YXR1cxInCgZzdGF0dXMYASABKAsyFy50cmVhZG1pbGwudjEuUnVuU3RhdHVzEg4KBmFjdG9ycxgCIAEoDRINCgVhbGl2ZRgDIAEoDSKSAQoIRnJvbVBhZ2USLAoHY29tbWFuZBgBIAEoCzIZLnRyZWFkbWlsbC52MS5QYWdlQ29tbWFuZEgAEiYKBHB1c2gYAiABKAsyFi50cmVhZG1pbGwudjEuUGFnZVB1c2hIABIoCgV3b3JsZBgDIAEoCzIXLnRyZWFkbWlsbC52MS5QYWdlV29ybGRIAEIGCgRraW5kIuUBCglQYWdlU2NlbmUSDQoFdGl0bGUYASABKAkSJwoGcm9ib3RzGAIgAygLMhcudHJlYWRtaWxsLnYxLlBhZ2VSb2JvdBImCgZncm91bmQYAyABKAsyFi50cmVhZG1pbGwudjEuUGFnZU1lc2gSEwoLY29tbWFuZF9sb3cYBCADKAISFAoMY29tbWFuZF9oaWdoGAUgAygCEg4KBnN0ZWVycxgGIAEoCBIVCg1ncm91bmRfbGV2ZWxzGAcgASgNEiYKBXdvcmxkGAggASgLMhcudHJlYWRtaWxsLnYxLlBhZ2VXb3JsZCKmAQoJUGFnZVJvYm90EgwKBG5hbWUYASABKAkSJgoGYm9kaWVzGAIgAygLMhYudHJlYWRtaWxsLnYxLlBhZ2VCb2R5EicKBmhpbmdlcxgDIAMoCzIXLnRyZWFkbWlsbC52MS5QYWdlSGluZ2USFAoMcmV3YXJkX3Rlcm1zGAQgAygJEiQKBGZlZXQYBSADKAsyFi50cmVhZG1pbGwudjEuUGFnZUZvb3QiJgoIUGFnZUZvb3QSDAoEYm9keRgBIAEoDRIMCgRhdF9tGAIgAygCIkAKCFBhZ2VCb2R5EgwKBG5hbWUYASABKAkSJgoGbWVzaGVzGAIgAygLMhYudHJlYWRtaWxsLnYxLlBhZ2VNZXNoInEKCFBhZ2VNZXNoEg8KB2Nvcm5lcnMYASABKAwSEQoJdHJpYW5nbGVzGAIgASgMEg4KBmNvbG91chgDIAEoDRISCgppc19mYWNldGVkGAQgASgIEg0KBWxvd19tGAUgAygCEg4KBnVuaXRfbRgGIAMoAiJhCglQYWdlSGluZ2USDAoEbmFtZRgBIAEoCRIPCgdsb3dfcmFkGAIgASgCEhAKCGhpZ2hfcmFkGAMgASgCEhEKCWVmZm9ydF9ubRgEIAEoAhIQCghpc19zZXJ2bxgFIAEoCCLHAgoJUGFnZUZyYW1lEg0KBXJvYm90GAEgASgNEg8KB2VwaXNvZGUYAiABKAQSDgoGdGltZV9zGAMgASgBEg8KB3Nob3duX3MYBCABKAESDgoGYmFzZV9tGAUgAygCEg4KBmJvZGllcxgGIAEoDBIQCghjb250YWN0cxgHIAEoDBITCgthbmdsZXNfbXJhZBgIIAMoERITCgt0b3JxdWVzX2NubRgJIAMoERISCgpyZXdhcmRzX2UzGAogAygREg8KB2NvbW1hbmQYCyADKAISEAoIdmVsb2NpdHkYDCADKAISEgoKZGlzdGFuY2VfbRgNIAEoAhIYChBjZW50cmVfb2ZfbWFzc19tGA4gAygCEhQKDGdob3N0X2Jhc2VfbRgPIAMoAhINCgVnaG9zdBgQIAEoDBITCgtjb250cm9sc19lMhgRIAMoESI1CgpQYWdlQ3VydmVzEicKBmN1cnZlcxgBIAMoCzIXLnRyZWFkbWlsbC52MS5QYWdlQ3VydmUiYwoJUGFnZUN1cnZlEgsKA3J1bhgBIAEoCRINCgVncm91cBgGIAEoCRILCgN0YWcYAiABKAkSDQoFc3RlcHMYAyADKAESDgoGd2FsbF9zGAQgAygBEg4KBnZhbHVlcxgFIAMoASJYCgtQYWdlQ29tbWFuZBIPCgdmb2xsb3dzGAEgASgIEhMKC2ZvcndhcmRfbXBzGAIgASgCEhAKCGxlZnRfbXBzGAMgASgCEhEKCXlhd19yYWRwcxgEIAEoAiIxCghQYWdlUHVzaBITCgtmb3J3YXJkX21wcxgBIAEoAhIQCghsZWZ0X21wcxgCIAEoAiJ+CglQYWdlV29ybGQSEgoKbWFzc19zY2FsZRgBIAEoAhIWCg5mcmljdGlvbl9zY2FsZRgCIAEoAhITCgttb3Rvcl9zY2FsZRgDIAEoAhIaChJhY3Rpb25fZGVsYXlfc3RlcHMYBCABKA0SFAoMZ3JvdW5kX2xldmVsGAUgASgNKlQKC1BhZ2VTdGVlcmVyEhUKEVBBR0VfU1RFRVJFUl9GUkVFEAASFAoQUEFHRV9TVEVFUkVSX1lPVRABEhgKFFBBR0VfU1RFRVJFUl9BTk9USEVSEAJiBnByb3RvMw",[j0]),Q0=ji(Jf,0);var jf=ji(Jf,2);var e_=ji(Jf,4);var t_=200,RM=2e3,IM=2e3,CM=1001,dc=class{constructor(e,t){this.received=e;this.changed=t;this.open()}received;changed;connected=!1;socket;pause_ms=t_;send(e){this.socket?.readyState===WebSocket.OPEN&&this.socket.send(hf(jf,yi(jf,{kind:e})))}open(){let e=new WebSocket(`${location.origin.replace("http","ws")}/socket${location.search}`);e.binaryType="arraybuffer";let t=1/0;e.onopen=()=>{t=performance.now(),this.changed(this.connected=!0,"")},e.onmessage=i=>{i.data instanceof ArrayBuffer&&this.received(dr(Q0,new Uint8Array(i.data)))},e.onclose=({code:i,reason:s})=>{this.changed(this.connected=!1,i===CM?s:""),performance.now()-t>IM&&(this.pause_ms=t_),setTimeout(()=>this.open(),this.pause_ms),this.pause_ms=Math.min(2*this.pause_ms,RM)},this.socket=e}};var ir={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},sr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},P_=0,Rd=1,N_=2;var Cr=1,L_=2,Xo=3,rr=0,Mn=1,os=2,Pr=0,Yo=1,Id=2,Cd=3,Pd=4,D_=5;var Nr=100,U_=101,O_=102,F_=103,B_=104,k_=200,G_=201,z_=202,V_=203,Nd=204,Ld=205,H_=206,W_=207,X_=208,Y_=209,K_=210,Z_=211,q_=212,$_=213,J_=214,Gc=0,zc=1,Vc=2,Po=3,Hc=4,Wc=5,Xc=6,Yc=7,pu=0,j_=1,Q_=2,as=0,Dd=1,Ud=2,Od=3,Fd=4,Bd=5,kd=6,hl=7;var Gd=300,Lr=301,Ko=302,mu=303,gu=304,Kc=1e3,ns=1001,Zc=1002,Ln=1003,ey=1004;var fl=1005;var Jn=1006,_u=1007;var Is=1008;var ti=1009,zd=1010,Vd=1011,Zo=1012,yu=1013,zi=1014,Ai=1015,Vi=1016,xu=1017,vu=1018,Dr=1020,Hd=35902,Wd=35899,Xd=1021,Yd=1022,Hi=1023,ws=1026,Cs=1027,bu=1028,Su=1029,or=1030,Mu=1031;var Eu=1033,dl=33776,pl=33777,ml=33778,gl=33779,Tu=35840,Au=35841,wu=35842,Ru=35843,Iu=36196,Cu=37492,Pu=37496,Nu=37488,Lu=37489,_l=37490,Du=37491,Uu=37808,Ou=37809,Fu=37810,Bu=37811,ku=37812,Gu=37813,zu=37814,Vu=37815,Hu=37816,Wu=37817,Xu=37818,Yu=37819,Ku=37820,Zu=37821,qu=36492,$u=36494,Ju=36495,ju=36283,Qu=36284,yl=36285,eh=36286;var Va=2300,qc=2301,Bc=2302,vd=2303,bd=2400,Sd=2401,Md=2402;var ty=3200;var xl=0,ny=1,Ps="",qn="srgb",Ha="srgb-linear",Wa="linear",It="srgb";var kc=7680;var iy=519,sy=512,ry=513,oy=514,Kd=515,ay=516,ly=517,Zd=518,qd=519,$d=35044;var Jd="300 es",Ei=2e3,No=2001;function PM(n){for(let e=n.length-1;e>=0;--e)if(n[e]>=65535)return!0;return!1}function NM(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function Xa(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function cy(){let n=Xa("canvas");return n.style.display="block",n}var n_={},Lo=null;function Ya(...n){let e="THREE."+n.shift();Lo?Lo("log",e,...n):console.log(e,...n)}function uy(n){let e=n[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=n[1];t&&t.isStackTrace?n[0]+=" "+t.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function qe(...n){n=uy(n);let e="THREE."+n.shift();if(Lo)Lo("warn",e,...n);else{let t=n[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...n)}}function Qe(...n){n=uy(n);let e="THREE."+n.shift();if(Lo)Lo("error",e,...n);else{let t=n[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...n)}}function ka(...n){let e=n.join(" ");e in n_||(n_[e]=!0,qe(...n))}function hy(n,e,t){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(e,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:i()}}setTimeout(r,t)})}var fy={[Gc]:Gc,[Vc]:Xc,[Hc]:Hc,[Po]:Wc,[zc]:zc,[Xc]:Vc,[Yc]:Yc,[Wc]:Po},Gi=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[e]===void 0&&(i[e]=[]),i[e].indexOf(t)===-1&&i[e].push(t)}hasEventListener(e,t){let i=this._listeners;return i===void 0?!1:i[e]!==void 0&&i[e].indexOf(t)!==-1}removeEventListener(e,t){let i=this._listeners;if(i===void 0)return;let s=i[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let i=t[e.type];if(i!==void 0){e.target=this;let s=i.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},Bn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],i_=1234567,Ga=Math.PI/180,Do=180/Math.PI;function ar(){let n=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(Bn[n&255]+Bn[n>>8&255]+Bn[n>>16&255]+Bn[n>>24&255]+"-"+Bn[e&255]+Bn[e>>8&255]+"-"+Bn[e>>16&15|64]+Bn[e>>24&255]+"-"+Bn[t&63|128]+Bn[t>>8&255]+"-"+Bn[t>>16&255]+Bn[t>>24&255]+Bn[i&255]+Bn[i>>8&255]+Bn[i>>16&255]+Bn[i>>24&255]).toLowerCase()}function mt(n,e,t){return Math.max(e,Math.min(t,n))}function jd(n,e){return(n%e+e)%e}function LM(n,e,t,i,s){return i+(n-e)*(s-i)/(t-e)}function DM(n,e,t){return n!==e?(t-n)/(e-n):0}function za(n,e,t){return(1-t)*n+t*e}function UM(n,e,t,i){return za(n,e,1-Math.exp(-t*i))}function OM(n,e=1){return e-Math.abs(jd(n,e*2)-e)}function FM(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*(3-2*n))}function BM(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*n*(n*(n*6-15)+10))}function kM(n,e){return n+Math.floor(Math.random()*(e-n+1))}function GM(n,e){return n+Math.random()*(e-n)}function zM(n){return n*(.5-Math.random())}function VM(n){n!==void 0&&(i_=n);let e=i_+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function HM(n){return n*Ga}function WM(n){return n*Do}function XM(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function YM(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function Qd(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function KM(n,e,t,i,s){let r=Math.cos,o=Math.sin,a=r(t/2),c=o(t/2),l=r((e+i)/2),u=o((e+i)/2),h=r((e-i)/2),f=o((e-i)/2),d=r((i-e)/2),p=o((i-e)/2);switch(s){case"XYX":n.set(a*u,c*h,c*f,a*l);break;case"YZY":n.set(c*f,a*u,c*h,a*l);break;case"ZXZ":n.set(c*h,c*f,a*u,a*l);break;case"XZX":n.set(a*u,c*p,c*d,a*l);break;case"YXY":n.set(c*d,a*u,c*p,a*l);break;case"ZYZ":n.set(c*p,c*d,a*u,a*l);break;default:qe("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function th(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function ep(n,e){if(e.constructor===Float32Array)return n;let t=th(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/t,-1)}function tp(n,e){if(e.constructor===Float32Array)return n;let t=th(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*t)}var nh={DEG2RAD:Ga,RAD2DEG:Do,generateUUID:ar,clamp:mt,euclideanModulo:jd,mapLinear:LM,inverseLerp:DM,lerp:za,damp:UM,pingpong:OM,smoothstep:FM,smootherstep:BM,randInt:kM,randFloat:GM,randFloatSpread:zM,seededRandom:VM,degToRad:HM,radToDeg:WM,isPowerOfTwo:XM,ceilPowerOfTwo:YM,floorPowerOfTwo:Qd,setQuaternionFromProperEuler:KM,normalize:tp,denormalize:ep},We=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,i=this.y,s=e.elements;return this.x=s[0]*t+s[3]*i+s[6],this.y=s[1]*t+s[4]*i+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=mt(this.x,e.x,t.x),this.y=mt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=mt(this.x,e,t),this.y=mt(this.y,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(mt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(mt(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y;return t*t+i*i}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let i=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*i-o*s+e.x,this.y=r*s+o*i+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},bn=class{constructor(e=0,t=0,i=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=i,this._w=s}static slerpFlat(e,t,i,s,r,o,a){let c=i[s+0],l=i[s+1],u=i[s+2],h=i[s+3],f=r[o+0],d=r[o+1],p=r[o+2],S=r[o+3];if(h!==S||c!==f||l!==d||u!==p){let g=c*f+l*d+u*p+h*S;g<0&&(f=-f,d=-d,p=-p,S=-S,g=-g);let m=1-a;if(g<.9995){let b=Math.acos(g),I=Math.sin(b);m=Math.sin(m*b)/I,a=Math.sin(a*b)/I,c=c*m+f*a,l=l*m+d*a,u=u*m+p*a,h=h*m+S*a}else{c=c*m+f*a,l=l*m+d*a,u=u*m+p*a,h=h*m+S*a;let b=1/Math.sqrt(c*c+l*l+u*u+h*h);c*=b,l*=b,u*=b,h*=b}}e[t]=c,e[t+1]=l,e[t+2]=u,e[t+3]=h}static multiplyQuaternionsFlat(e,t,i,s,r,o){let a=i[s],c=i[s+1],l=i[s+2],u=i[s+3],h=r[o],f=r[o+1],d=r[o+2],p=r[o+3];return e[t]=a*p+u*h+c*d-l*f,e[t+1]=c*p+u*f+l*h-a*d,e[t+2]=l*p+u*d+a*f-c*h,e[t+3]=u*p-a*h-c*f-l*d,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,i,s){return this._x=e,this._y=t,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let i=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,c=Math.sin,l=a(i/2),u=a(s/2),h=a(r/2),f=c(i/2),d=c(s/2),p=c(r/2);switch(o){case"XYZ":this._x=f*u*h+l*d*p,this._y=l*d*h-f*u*p,this._z=l*u*p+f*d*h,this._w=l*u*h-f*d*p;break;case"YXZ":this._x=f*u*h+l*d*p,this._y=l*d*h-f*u*p,this._z=l*u*p-f*d*h,this._w=l*u*h+f*d*p;break;case"ZXY":this._x=f*u*h-l*d*p,this._y=l*d*h+f*u*p,this._z=l*u*p+f*d*h,this._w=l*u*h-f*d*p;break;case"ZYX":this._x=f*u*h-l*d*p,this._y=l*d*h+f*u*p,this._z=l*u*p-f*d*h,this._w=l*u*h+f*d*p;break;case"YZX":this._x=f*u*h+l*d*p,this._y=l*d*h+f*u*p,this._z=l*u*p-f*d*h,this._w=l*u*h-f*d*p;break;case"XZY":this._x=f*u*h-l*d*p,this._y=l*d*h-f*u*p,this._z=l*u*p+f*d*h,this._w=l*u*h+f*d*p;break;default:qe("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let i=t/2,s=Math.sin(i);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,i=t[0],s=t[4],r=t[8],o=t[1],a=t[5],c=t[9],l=t[2],u=t[6],h=t[10],f=i+a+h;if(f>0){let d=.5/Math.sqrt(f+1);this._w=.25/d,this._x=(u-c)*d,this._y=(r-l)*d,this._z=(o-s)*d}else if(i>a&&i>h){let d=2*Math.sqrt(1+i-a-h);this._w=(u-c)/d,this._x=.25*d,this._y=(s+o)/d,this._z=(r+l)/d}else if(a>h){let d=2*Math.sqrt(1+a-i-h);this._w=(r-l)/d,this._x=(s+o)/d,this._y=.25*d,this._z=(c+u)/d}else{let d=2*Math.sqrt(1+h-i-a);this._w=(o-s)/d,this._x=(r+l)/d,this._y=(c+u)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let i=e.dot(t)+1;return i<1e-8?(i=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=i):(this._x=0,this._y=-e.z,this._z=e.y,this._w=i)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=i),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(mt(this.dot(e),-1,1)))}rotateTowards(e,t){let i=this.angleTo(e);if(i===0)return this;let s=Math.min(1,t/i);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=t._x,c=t._y,l=t._z,u=t._w;return this._x=i*u+o*a+s*l-r*c,this._y=s*u+o*c+r*a-i*l,this._z=r*u+o*l+i*c-s*a,this._w=o*u-i*a-s*c-r*l,this._onChangeCallback(),this}slerp(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(i=-i,s=-s,r=-r,o=-o,a=-a);let c=1-t;if(a<.9995){let l=Math.acos(a),u=Math.sin(l);c=Math.sin(c*l)/u,t=Math.sin(t*l)/u,this._x=this._x*c+i*t,this._y=this._y*c+s*t,this._z=this._z*c+r*t,this._w=this._w*c+o*t,this._onChangeCallback()}else this._x=this._x*c+i*t,this._y=this._y*c+s*t,this._z=this._z*c+r*t,this._w=this._w*c+o*t,this.normalize();return this}slerpQuaternions(e,t,i){return this.copy(e).slerp(t,i)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},W=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,i=0){this.x=e,this.y=t,this.z=i}set(e,t,i){return i===void 0&&(i=this.z),this.x=e,this.y=t,this.z=i,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(s_.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(s_.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*i+r[6]*s,this.y=r[1]*t+r[4]*i+r[7]*s,this.z=r[2]*t+r[5]*i+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*i+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*i+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*i+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,i=this.y,s=this.z,r=e.x,o=e.y,a=e.z,c=e.w,l=2*(o*s-a*i),u=2*(a*t-r*s),h=2*(r*i-o*t);return this.x=t+c*l+o*h-a*u,this.y=i+c*u+a*l-r*h,this.z=s+c*h+r*u-o*l,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*i+r[8]*s,this.y=r[1]*t+r[5]*i+r[9]*s,this.z=r[2]*t+r[6]*i+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=mt(this.x,e.x,t.x),this.y=mt(this.y,e.y,t.y),this.z=mt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=mt(this.x,e,t),this.y=mt(this.y,e,t),this.z=mt(this.z,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(mt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let i=e.x,s=e.y,r=e.z,o=t.x,a=t.y,c=t.z;return this.x=s*c-r*a,this.y=r*o-i*c,this.z=i*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let i=e.dot(this)/t;return this.copy(e).multiplyScalar(i)}projectOnPlane(e){return Qf.copy(this).projectOnVector(e),this.sub(Qf)}reflect(e){return this.sub(Qf.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(mt(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y,s=this.z-e.z;return t*t+i*i+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,i){let s=Math.sin(t)*e;return this.x=s*Math.sin(i),this.y=Math.cos(t)*e,this.z=s*Math.cos(i),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,i){return this.x=e*Math.sin(t),this.y=i,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),i=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=i,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,i=Math.sqrt(1-t*t);return this.x=i*Math.cos(e),this.y=t,this.z=i*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Qf=new W,s_=new bn,nt=class{static{this.prototype.isMatrix3=!0}constructor(e,t,i,s,r,o,a,c,l){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,c,l)}set(e,t,i,s,r,o,a,c,l){let u=this.elements;return u[0]=e,u[1]=s,u[2]=a,u[3]=t,u[4]=r,u[5]=c,u[6]=i,u[7]=o,u[8]=l,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],this}extractBasis(e,t,i){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[3],c=i[6],l=i[1],u=i[4],h=i[7],f=i[2],d=i[5],p=i[8],S=s[0],g=s[3],m=s[6],b=s[1],I=s[4],x=s[7],w=s[2],A=s[5],_=s[8];return r[0]=o*S+a*b+c*w,r[3]=o*g+a*I+c*A,r[6]=o*m+a*x+c*_,r[1]=l*S+u*b+h*w,r[4]=l*g+u*I+h*A,r[7]=l*m+u*x+h*_,r[2]=f*S+d*b+p*w,r[5]=f*g+d*I+p*A,r[8]=f*m+d*x+p*_,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],c=e[6],l=e[7],u=e[8];return t*o*u-t*a*l-i*r*u+i*a*c+s*r*l-s*o*c}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],c=e[6],l=e[7],u=e[8],h=u*o-a*l,f=a*c-u*r,d=l*r-o*c,p=t*h+i*f+s*d;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let S=1/p;return e[0]=h*S,e[1]=(s*l-u*i)*S,e[2]=(a*i-s*o)*S,e[3]=f*S,e[4]=(u*t-s*c)*S,e[5]=(s*r-a*t)*S,e[6]=d*S,e[7]=(i*c-l*t)*S,e[8]=(o*t-i*r)*S,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,i,s,r,o,a){let c=Math.cos(r),l=Math.sin(r);return this.set(i*c,i*l,-i*(c*o+l*a)+o+e,-s*l,s*c,-s*(-l*o+c*a)+a+t,0,0,1),this}scale(e,t){return ka("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(ed.makeScale(e,t)),this}rotate(e){return ka("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(ed.makeRotation(-e)),this}translate(e,t){return ka("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(ed.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,i,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<9;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<9;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e}clone(){return new this.constructor().fromArray(this.elements)}},ed=new nt,r_=new nt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),o_=new nt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function ZM(){let n={enabled:!0,workingColorSpace:Ha,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===It&&(s.r=As(s.r),s.g=As(s.g),s.b=As(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===It&&(s.r=Co(s.r),s.g=Co(s.g),s.b=Co(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Ps?Wa:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[Ha]:{primaries:e,whitePoint:i,transfer:Wa,toXYZ:r_,fromXYZ:o_,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:qn},outputColorSpaceConfig:{drawingBufferColorSpace:qn}},[qn]:{primaries:e,whitePoint:i,transfer:It,toXYZ:r_,fromXYZ:o_,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:qn}}}),n}var xt=ZM();function As(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function Co(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var ho,$c=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let i;if(e instanceof HTMLCanvasElement)i=e;else{ho===void 0&&(ho=Xa("canvas")),ho.width=e.width,ho.height=e.height;let s=ho.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),i=ho}return i.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=Xa("canvas");t.width=e.width,t.height=e.height;let i=t.getContext("2d");i.drawImage(e,0,0,e.width,e.height);let s=i.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=As(r[o]/255)*255;return i.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let i=0;i<t.length;i++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[i]=Math.floor(As(t[i]/255)*255):t[i]=As(t[i]);return{data:t,width:e.width,height:e.height}}else return qe("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},qM=0,Uo=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:qM++}),this.uuid=ar(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(td(s[o].image)):r.push(td(s[o]))}else r=td(s);i.url=r}return t||(e.images[this.uuid]=i),i}};function td(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?$c.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(qe("Texture: Unable to serialize Texture."),{})}var $M=0,nd=new W,jn=class n extends Gi{constructor(e=n.DEFAULT_IMAGE,t=n.DEFAULT_MAPPING,i=ns,s=ns,r=Jn,o=Is,a=Hi,c=ti,l=n.DEFAULT_ANISOTROPY,u=Ps){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:$M++}),this.uuid=ar(),this.name="",this.source=new Uo(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=l,this.format=a,this.internalFormat=null,this.type=c,this.offset=new We(0,0),this.repeat=new We(1,1),this.center=new We(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new nt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=u,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(nd).x}get height(){return this.source.getSize(nd).y}get depth(){return this.source.getSize(nd).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let i=e[t];if(i===void 0){qe(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){qe(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),t||(e.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Gd)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case Kc:e.x=e.x-Math.floor(e.x);break;case ns:e.x=e.x<0?0:1;break;case Zc:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case Kc:e.y=e.y-Math.floor(e.y);break;case ns:e.y=e.y<0?0:1;break;case Zc:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};jn.DEFAULT_IMAGE=null;jn.DEFAULT_MAPPING=Gd;jn.DEFAULT_ANISOTROPY=1;var qt=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,i=0,s=1){this.x=e,this.y=t,this.z=i,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,i,s){return this.x=e,this.y=t,this.z=i,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*i+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*i+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*i+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*i+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,i,s,r,c=e.elements,l=c[0],u=c[4],h=c[8],f=c[1],d=c[5],p=c[9],S=c[2],g=c[6],m=c[10];if(Math.abs(u-f)<.01&&Math.abs(h-S)<.01&&Math.abs(p-g)<.01){if(Math.abs(u+f)<.1&&Math.abs(h+S)<.1&&Math.abs(p+g)<.1&&Math.abs(l+d+m-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let I=(l+1)/2,x=(d+1)/2,w=(m+1)/2,A=(u+f)/4,_=(h+S)/4,T=(p+g)/4;return I>x&&I>w?I<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(I),s=A/i,r=_/i):x>w?x<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(x),i=A/s,r=T/s):w<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(w),i=_/r,s=T/r),this.set(i,s,r,t),this}let b=Math.sqrt((g-p)*(g-p)+(h-S)*(h-S)+(f-u)*(f-u));return Math.abs(b)<.001&&(b=1),this.x=(g-p)/b,this.y=(h-S)/b,this.z=(f-u)/b,this.w=Math.acos((l+d+m-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=mt(this.x,e.x,t.x),this.y=mt(this.y,e.y,t.y),this.z=mt(this.z,e.z,t.z),this.w=mt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=mt(this.x,e,t),this.y=mt(this.y,e,t),this.z=mt(this.z,e,t),this.w=mt(this.w,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(mt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this.w=e.w+(t.w-e.w)*i,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Jc=class extends Gi{constructor(e=1,t=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Jn,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=i.depth,this.scissor=new qt(0,0,e,t),this.scissorTest=!1,this.viewport=new qt(0,0,e,t),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new jn({width:e,height:t,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:Jn,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,i=1){if(this.width!==e||this.height!==t||this.depth!==i){this.width=e,this.height=t,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,i=e.textures.length;t<i;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new Uo(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},di=class extends Jc{constructor(e=1,t=1,i={}){super(e,t,i),this.isWebGLRenderTarget=!0}},Ka=class extends jn{constructor(e=null,t=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=Ln,this.minFilter=Ln,this.wrapR=ns,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var jc=class extends jn{constructor(e=null,t=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=Ln,this.minFilter=Ln,this.wrapR=ns,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var Tt=class n{static{this.prototype.isMatrix4=!0}constructor(e,t,i,s,r,o,a,c,l,u,h,f,d,p,S,g){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,c,l,u,h,f,d,p,S,g)}set(e,t,i,s,r,o,a,c,l,u,h,f,d,p,S,g){let m=this.elements;return m[0]=e,m[4]=t,m[8]=i,m[12]=s,m[1]=r,m[5]=o,m[9]=a,m[13]=c,m[2]=l,m[6]=u,m[10]=h,m[14]=f,m[3]=d,m[7]=p,m[11]=S,m[15]=g,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],t[9]=i[9],t[10]=i[10],t[11]=i[11],t[12]=i[12],t[13]=i[13],t[14]=i[14],t[15]=i[15],this}copyPosition(e){let t=this.elements,i=e.elements;return t[12]=i[12],t[13]=i[13],t[14]=i[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,i){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),i.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(e,t,i){return this.set(e.x,t.x,i.x,0,e.y,t.y,i.y,0,e.z,t.z,i.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,i=e.elements,s=1/fo.setFromMatrixColumn(e,0).length(),r=1/fo.setFromMatrixColumn(e,1).length(),o=1/fo.setFromMatrixColumn(e,2).length();return t[0]=i[0]*s,t[1]=i[1]*s,t[2]=i[2]*s,t[3]=0,t[4]=i[4]*r,t[5]=i[5]*r,t[6]=i[6]*r,t[7]=0,t[8]=i[8]*o,t[9]=i[9]*o,t[10]=i[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,i=e.x,s=e.y,r=e.z,o=Math.cos(i),a=Math.sin(i),c=Math.cos(s),l=Math.sin(s),u=Math.cos(r),h=Math.sin(r);if(e.order==="XYZ"){let f=o*u,d=o*h,p=a*u,S=a*h;t[0]=c*u,t[4]=-c*h,t[8]=l,t[1]=d+p*l,t[5]=f-S*l,t[9]=-a*c,t[2]=S-f*l,t[6]=p+d*l,t[10]=o*c}else if(e.order==="YXZ"){let f=c*u,d=c*h,p=l*u,S=l*h;t[0]=f+S*a,t[4]=p*a-d,t[8]=o*l,t[1]=o*h,t[5]=o*u,t[9]=-a,t[2]=d*a-p,t[6]=S+f*a,t[10]=o*c}else if(e.order==="ZXY"){let f=c*u,d=c*h,p=l*u,S=l*h;t[0]=f-S*a,t[4]=-o*h,t[8]=p+d*a,t[1]=d+p*a,t[5]=o*u,t[9]=S-f*a,t[2]=-o*l,t[6]=a,t[10]=o*c}else if(e.order==="ZYX"){let f=o*u,d=o*h,p=a*u,S=a*h;t[0]=c*u,t[4]=p*l-d,t[8]=f*l+S,t[1]=c*h,t[5]=S*l+f,t[9]=d*l-p,t[2]=-l,t[6]=a*c,t[10]=o*c}else if(e.order==="YZX"){let f=o*c,d=o*l,p=a*c,S=a*l;t[0]=c*u,t[4]=S-f*h,t[8]=p*h+d,t[1]=h,t[5]=o*u,t[9]=-a*u,t[2]=-l*u,t[6]=d*h+p,t[10]=f-S*h}else if(e.order==="XZY"){let f=o*c,d=o*l,p=a*c,S=a*l;t[0]=c*u,t[4]=-h,t[8]=l*u,t[1]=f*h+S,t[5]=o*u,t[9]=d*h-p,t[2]=p*h-d,t[6]=a*u,t[10]=S*h+f}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(JM,e,jM)}lookAt(e,t,i){let s=this.elements;return hi.subVectors(e,t),hi.lengthSq()===0&&(hi.z=1),hi.normalize(),Ws.crossVectors(i,hi),Ws.lengthSq()===0&&(Math.abs(i.z)===1?hi.x+=1e-4:hi.z+=1e-4,hi.normalize(),Ws.crossVectors(i,hi)),Ws.normalize(),pc.crossVectors(hi,Ws),s[0]=Ws.x,s[4]=pc.x,s[8]=hi.x,s[1]=Ws.y,s[5]=pc.y,s[9]=hi.y,s[2]=Ws.z,s[6]=pc.z,s[10]=hi.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[4],c=i[8],l=i[12],u=i[1],h=i[5],f=i[9],d=i[13],p=i[2],S=i[6],g=i[10],m=i[14],b=i[3],I=i[7],x=i[11],w=i[15],A=s[0],_=s[4],T=s[8],F=s[12],D=s[1],P=s[5],B=s[9],G=s[13],N=s[2],V=s[6],Y=s[10],z=s[14],le=s[3],q=s[7],j=s[11],te=s[15];return r[0]=o*A+a*D+c*N+l*le,r[4]=o*_+a*P+c*V+l*q,r[8]=o*T+a*B+c*Y+l*j,r[12]=o*F+a*G+c*z+l*te,r[1]=u*A+h*D+f*N+d*le,r[5]=u*_+h*P+f*V+d*q,r[9]=u*T+h*B+f*Y+d*j,r[13]=u*F+h*G+f*z+d*te,r[2]=p*A+S*D+g*N+m*le,r[6]=p*_+S*P+g*V+m*q,r[10]=p*T+S*B+g*Y+m*j,r[14]=p*F+S*G+g*z+m*te,r[3]=b*A+I*D+x*N+w*le,r[7]=b*_+I*P+x*V+w*q,r[11]=b*T+I*B+x*Y+w*j,r[15]=b*F+I*G+x*z+w*te,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[12],o=e[1],a=e[5],c=e[9],l=e[13],u=e[2],h=e[6],f=e[10],d=e[14],p=e[3],S=e[7],g=e[11],m=e[15],b=c*d-l*f,I=a*d-l*h,x=a*f-c*h,w=o*d-l*u,A=o*f-c*u,_=o*h-a*u;return t*(S*b-g*I+m*x)-i*(p*b-g*w+m*A)+s*(p*I-S*w+m*_)-r*(p*x-S*A+g*_)}determinantAffine(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[1],o=e[5],a=e[9],c=e[2],l=e[6],u=e[10];return t*(o*u-a*l)-i*(r*u-a*c)+s*(r*l-o*c)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,i){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=i),this}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],c=e[6],l=e[7],u=e[8],h=e[9],f=e[10],d=e[11],p=e[12],S=e[13],g=e[14],m=e[15],b=t*a-i*o,I=t*c-s*o,x=t*l-r*o,w=i*c-s*a,A=i*l-r*a,_=s*l-r*c,T=u*S-h*p,F=u*g-f*p,D=u*m-d*p,P=h*g-f*S,B=h*m-d*S,G=f*m-d*g,N=b*G-I*B+x*P+w*D-A*F+_*T;if(N===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let V=1/N;return e[0]=(a*G-c*B+l*P)*V,e[1]=(s*B-i*G-r*P)*V,e[2]=(S*_-g*A+m*w)*V,e[3]=(f*A-h*_-d*w)*V,e[4]=(c*D-o*G-l*F)*V,e[5]=(t*G-s*D+r*F)*V,e[6]=(g*x-p*_-m*I)*V,e[7]=(u*_-f*x+d*I)*V,e[8]=(o*B-a*D+l*T)*V,e[9]=(i*D-t*B-r*T)*V,e[10]=(p*A-S*x+m*b)*V,e[11]=(h*x-u*A-d*b)*V,e[12]=(a*F-o*P-c*T)*V,e[13]=(t*P-i*F+s*T)*V,e[14]=(S*I-p*w-g*b)*V,e[15]=(u*w-h*I+f*b)*V,this}scale(e){let t=this.elements,i=e.x,s=e.y,r=e.z;return t[0]*=i,t[4]*=s,t[8]*=r,t[1]*=i,t[5]*=s,t[9]*=r,t[2]*=i,t[6]*=s,t[10]*=r,t[3]*=i,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],i=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,i,s))}makeTranslation(e,t,i){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,i,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),i=Math.sin(e);return this.set(1,0,0,0,0,t,-i,0,0,i,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,0,i,0,0,1,0,0,-i,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,0,i,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let i=Math.cos(t),s=Math.sin(t),r=1-i,o=e.x,a=e.y,c=e.z,l=r*o,u=r*a;return this.set(l*o+i,l*a-s*c,l*c+s*a,0,l*a+s*c,u*a+i,u*c-s*o,0,l*c-s*a,u*c+s*o,r*c*c+i,0,0,0,0,1),this}makeScale(e,t,i){return this.set(e,0,0,0,0,t,0,0,0,0,i,0,0,0,0,1),this}makeShear(e,t,i,s,r,o){return this.set(1,i,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,i){let s=this.elements,r=t._x,o=t._y,a=t._z,c=t._w,l=r+r,u=o+o,h=a+a,f=r*l,d=r*u,p=r*h,S=o*u,g=o*h,m=a*h,b=c*l,I=c*u,x=c*h,w=i.x,A=i.y,_=i.z;return s[0]=(1-(S+m))*w,s[1]=(d+x)*w,s[2]=(p-I)*w,s[3]=0,s[4]=(d-x)*A,s[5]=(1-(f+m))*A,s[6]=(g+b)*A,s[7]=0,s[8]=(p+I)*_,s[9]=(g-b)*_,s[10]=(1-(f+S))*_,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,i){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),t.identity(),this;let o=fo.set(s[0],s[1],s[2]).length(),a=fo.set(s[4],s[5],s[6]).length(),c=fo.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Fi.copy(this);let l=1/o,u=1/a,h=1/c;return Fi.elements[0]*=l,Fi.elements[1]*=l,Fi.elements[2]*=l,Fi.elements[4]*=u,Fi.elements[5]*=u,Fi.elements[6]*=u,Fi.elements[8]*=h,Fi.elements[9]*=h,Fi.elements[10]*=h,t.setFromRotationMatrix(Fi),i.x=o,i.y=a,i.z=c,this}makePerspective(e,t,i,s,r,o,a=Ei,c=!1){let l=this.elements,u=2*r/(t-e),h=2*r/(i-s),f=(t+e)/(t-e),d=(i+s)/(i-s),p,S;if(c)p=r/(o-r),S=o*r/(o-r);else if(a===Ei)p=-(o+r)/(o-r),S=-2*o*r/(o-r);else if(a===No)p=-o/(o-r),S=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return l[0]=u,l[4]=0,l[8]=f,l[12]=0,l[1]=0,l[5]=h,l[9]=d,l[13]=0,l[2]=0,l[6]=0,l[10]=p,l[14]=S,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(e,t,i,s,r,o,a=Ei,c=!1){let l=this.elements,u=2/(t-e),h=2/(i-s),f=-(t+e)/(t-e),d=-(i+s)/(i-s),p,S;if(c)p=1/(o-r),S=o/(o-r);else if(a===Ei)p=-2/(o-r),S=-(o+r)/(o-r);else if(a===No)p=-1/(o-r),S=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return l[0]=u,l[4]=0,l[8]=0,l[12]=f,l[1]=0,l[5]=h,l[9]=0,l[13]=d,l[2]=0,l[6]=0,l[10]=p,l[14]=S,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<16;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<16;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e[t+9]=i[9],e[t+10]=i[10],e[t+11]=i[11],e[t+12]=i[12],e[t+13]=i[13],e[t+14]=i[14],e[t+15]=i[15],e}},fo=new W,Fi=new Tt,JM=new W(0,0,0),jM=new W(1,1,1),Ws=new W,pc=new W,hi=new W,a_=new Tt,l_=new bn,is=class n{constructor(e=0,t=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=i,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,i,s=this._order){return this._x=e,this._y=t,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,i=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],c=s[1],l=s[5],u=s[9],h=s[2],f=s[6],d=s[10];switch(t){case"XYZ":this._y=Math.asin(mt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-u,d),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(f,l),this._z=0);break;case"YXZ":this._x=Math.asin(-mt(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(a,d),this._z=Math.atan2(c,l)):(this._y=Math.atan2(-h,r),this._z=0);break;case"ZXY":this._x=Math.asin(mt(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-h,d),this._z=Math.atan2(-o,l)):(this._y=0,this._z=Math.atan2(c,r));break;case"ZYX":this._y=Math.asin(-mt(h,-1,1)),Math.abs(h)<.9999999?(this._x=Math.atan2(f,d),this._z=Math.atan2(c,r)):(this._x=0,this._z=Math.atan2(-o,l));break;case"YZX":this._z=Math.asin(mt(c,-1,1)),Math.abs(c)<.9999999?(this._x=Math.atan2(-u,l),this._y=Math.atan2(-h,r)):(this._x=0,this._y=Math.atan2(a,d));break;case"XZY":this._z=Math.asin(-mt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(f,l),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-u,d),this._y=0);break;default:qe("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,i===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,i){return a_.makeRotationFromQuaternion(e),this.setFromRotationMatrix(a_,t,i)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return l_.setFromEuler(this),this.setFromQuaternion(l_,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};is.DEFAULT_ORDER="XYZ";var Za=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},QM=0,c_=new W,po=new bn,vs=new Tt,mc=new W,Ca=new W,eE=new W,tE=new bn,u_=new W(1,0,0),h_=new W(0,1,0),f_=new W(0,0,1),d_={type:"added"},nE={type:"removed"},mo={type:"childadded",child:null},id={type:"childremoved",child:null},Sn=class n extends Gi{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:QM++}),this.uuid=ar(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let e=new W,t=new is,i=new bn,s=new W(1,1,1);function r(){i.setFromEuler(t,!1)}function o(){t.setFromQuaternion(i,void 0,!1)}t._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Tt},normalMatrix:{value:new nt}}),this.matrix=new Tt,this.matrixWorld=new Tt,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Za,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return po.setFromAxisAngle(e,t),this.quaternion.multiply(po),this}rotateOnWorldAxis(e,t){return po.setFromAxisAngle(e,t),this.quaternion.premultiply(po),this}rotateX(e){return this.rotateOnAxis(u_,e)}rotateY(e){return this.rotateOnAxis(h_,e)}rotateZ(e){return this.rotateOnAxis(f_,e)}translateOnAxis(e,t){return c_.copy(e).applyQuaternion(this.quaternion),this.position.add(c_.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(u_,e)}translateY(e){return this.translateOnAxis(h_,e)}translateZ(e){return this.translateOnAxis(f_,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(vs.copy(this.matrixWorld).invert())}lookAt(e,t,i){e.isVector3?mc.copy(e):mc.set(e,t,i);let s=this.parent;this.updateWorldMatrix(!0,!1),Ca.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?vs.lookAt(Ca,mc,this.up):vs.lookAt(mc,Ca,this.up),this.quaternion.setFromRotationMatrix(vs),s&&(vs.extractRotation(s.matrixWorld),po.setFromRotationMatrix(vs),this.quaternion.premultiply(po.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(Qe("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(d_),mo.child=e,this.dispatchEvent(mo),mo.child=null):Qe("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(nE),id.child=e,this.dispatchEvent(id),id.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),vs.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),vs.multiply(e.parent.matrixWorld)),e.applyMatrix4(vs),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(d_),mo.child=e,this.dispatchEvent(mo),mo.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let i=0,s=this.children.length;i<s;i++){let o=this.children[i].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,i=[]){this[e]===t&&i.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,i);return i}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ca,e,eE),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ca,tE,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,i=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*i-r[8]*s,r[13]+=i-r[1]*t-r[5]*i-r[9]*s,r[14]+=s-r[2]*t-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].updateMatrixWorld(e)}updateWorldMatrix(e,t,i=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(e){let t=e===void 0||typeof e=="string",i={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,c){return a[c.uuid]===void 0&&(a[c.uuid]=c.toJSON(e)),c.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let c=a.shapes;if(Array.isArray(c))for(let l=0,u=c.length;l<u;l++){let h=c[l];r(e.shapes,h)}else r(e.shapes,c)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let c=0,l=this.material.length;c<l;c++)a.push(r(e.materials,this.material[c]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let c=this.animations[a];s.animations.push(r(e.animations,c))}}if(t){let a=o(e.geometries),c=o(e.materials),l=o(e.textures),u=o(e.images),h=o(e.shapes),f=o(e.skeletons),d=o(e.animations),p=o(e.nodes);a.length>0&&(i.geometries=a),c.length>0&&(i.materials=c),l.length>0&&(i.textures=l),u.length>0&&(i.images=u),h.length>0&&(i.shapes=h),f.length>0&&(i.skeletons=f),d.length>0&&(i.animations=d),p.length>0&&(i.nodes=p)}return i.object=s,i;function o(a){let c=[];for(let l in a){let u=a[l];delete u.metadata,c.push(u)}return c}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let i=0;i<e.children.length;i++){let s=e.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};Sn.DEFAULT_UP=new W(0,1,0);Sn.DEFAULT_MATRIX_AUTO_UPDATE=!0;Sn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var On=class extends Sn{constructor(){super(),this.isGroup=!0,this.type="Group"}},iE={type:"move"},Oo=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new On,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new On,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new W,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new W),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new On,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new W,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new W,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let i of e.hand.values())this._getHandJoint(t,i)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,i){let s=null,r=null,o=null,a=this._targetRay,c=this._grip,l=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(l&&e.hand){o=!0;for(let S of e.hand.values()){let g=t.getJointPose(S,i),m=this._getHandJoint(l,S);g!==null&&(m.matrix.fromArray(g.transform.matrix),m.matrix.decompose(m.position,m.quaternion,m.scale),m.matrixWorldNeedsUpdate=!0,m.jointRadius=g.radius),m.visible=g!==null}let u=l.joints["index-finger-tip"],h=l.joints["thumb-tip"],f=u.position.distanceTo(h.position),d=.02,p=.005;l.inputState.pinching&&f>d+p?(l.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!l.inputState.pinching&&f<=d-p&&(l.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else c!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,i),r!==null&&(c.matrix.fromArray(r.transform.matrix),c.matrix.decompose(c.position,c.quaternion,c.scale),c.matrixWorldNeedsUpdate=!0,r.linearVelocity?(c.hasLinearVelocity=!0,c.linearVelocity.copy(r.linearVelocity)):c.hasLinearVelocity=!1,r.angularVelocity?(c.hasAngularVelocity=!0,c.angularVelocity.copy(r.angularVelocity)):c.hasAngularVelocity=!1,c.eventsEnabled&&c.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(iE)))}return a!==null&&(a.visible=s!==null),c!==null&&(c.visible=r!==null),l!==null&&(l.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let i=new On;i.matrixAutoUpdate=!1,i.visible=!1,e.joints[t.jointName]=i,e.add(i)}return e.joints[t.jointName]}},dy={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Xs={h:0,s:0,l:0},gc={h:0,s:0,l:0};function sd(n,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?n+(e-n)*6*t:t<1/2?e:t<2/3?n+(e-n)*6*(2/3-t):n}var rt=class{constructor(e,t,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,i)}set(e,t,i){if(t===void 0&&i===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,i);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=qn){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,xt.colorSpaceToWorking(this,t),this}setRGB(e,t,i,s=xt.workingColorSpace){return this.r=e,this.g=t,this.b=i,xt.colorSpaceToWorking(this,s),this}setHSL(e,t,i,s=xt.workingColorSpace){if(e=jd(e,1),t=mt(t,0,1),i=mt(i,0,1),t===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+t):i+t-i*t,o=2*i-r;this.r=sd(o,r,e+1/3),this.g=sd(o,r,e),this.b=sd(o,r,e-1/3)}return xt.colorSpaceToWorking(this,s),this}setStyle(e,t=qn){function i(r){r!==void 0&&parseFloat(r)<1&&qe("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:qe("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);qe("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=qn){let i=dy[e.toLowerCase()];return i!==void 0?this.setHex(i,t):qe("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=As(e.r),this.g=As(e.g),this.b=As(e.b),this}copyLinearToSRGB(e){return this.r=Co(e.r),this.g=Co(e.g),this.b=Co(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=qn){return xt.workingToColorSpace(kn.copy(this),e),Math.round(mt(kn.r*255,0,255))*65536+Math.round(mt(kn.g*255,0,255))*256+Math.round(mt(kn.b*255,0,255))}getHexString(e=qn){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=xt.workingColorSpace){xt.workingToColorSpace(kn.copy(this),t);let i=kn.r,s=kn.g,r=kn.b,o=Math.max(i,s,r),a=Math.min(i,s,r),c,l,u=(a+o)/2;if(a===o)c=0,l=0;else{let h=o-a;switch(l=u<=.5?h/(o+a):h/(2-o-a),o){case i:c=(s-r)/h+(s<r?6:0);break;case s:c=(r-i)/h+2;break;case r:c=(i-s)/h+4;break}c/=6}return e.h=c,e.s=l,e.l=u,e}getRGB(e,t=xt.workingColorSpace){return xt.workingToColorSpace(kn.copy(this),t),e.r=kn.r,e.g=kn.g,e.b=kn.b,e}getStyle(e=qn){xt.workingToColorSpace(kn.copy(this),e);let t=kn.r,i=kn.g,s=kn.b;return e!==qn?`color(${e} ${t.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(e,t,i){return this.getHSL(Xs),this.setHSL(Xs.h+e,Xs.s+t,Xs.l+i)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,i){return this.r=e.r+(t.r-e.r)*i,this.g=e.g+(t.g-e.g)*i,this.b=e.b+(t.b-e.b)*i,this}lerpHSL(e,t){this.getHSL(Xs),e.getHSL(gc);let i=za(Xs.h,gc.h,t),s=za(Xs.s,gc.s,t),r=za(Xs.l,gc.l,t);return this.setHSL(i,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,i=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*i+r[6]*s,this.g=r[1]*t+r[4]*i+r[7]*s,this.b=r[2]*t+r[5]*i+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},kn=new rt;rt.NAMES=dy;var Er=class extends Sn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new is,this.environmentIntensity=1,this.environmentRotation=new is,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},Bi=new W,bs=new W,rd=new W,Ss=new W,go=new W,_o=new W,p_=new W,od=new W,ad=new W,ld=new W,cd=new qt,ud=new qt,hd=new qt,Ts=class n{constructor(e=new W,t=new W,i=new W){this.a=e,this.b=t,this.c=i}static getNormal(e,t,i,s){s.subVectors(i,t),Bi.subVectors(e,t),s.cross(Bi);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,i,s,r){Bi.subVectors(s,t),bs.subVectors(i,t),rd.subVectors(e,t);let o=Bi.dot(Bi),a=Bi.dot(bs),c=Bi.dot(rd),l=bs.dot(bs),u=bs.dot(rd),h=o*l-a*a;if(h===0)return r.set(0,0,0),null;let f=1/h,d=(l*c-a*u)*f,p=(o*u-a*c)*f;return r.set(1-d-p,p,d)}static containsPoint(e,t,i,s){return this.getBarycoord(e,t,i,s,Ss)===null?!1:Ss.x>=0&&Ss.y>=0&&Ss.x+Ss.y<=1}static getInterpolation(e,t,i,s,r,o,a,c){return this.getBarycoord(e,t,i,s,Ss)===null?(c.x=0,c.y=0,"z"in c&&(c.z=0),"w"in c&&(c.w=0),null):(c.setScalar(0),c.addScaledVector(r,Ss.x),c.addScaledVector(o,Ss.y),c.addScaledVector(a,Ss.z),c)}static getInterpolatedAttribute(e,t,i,s,r,o){return cd.setScalar(0),ud.setScalar(0),hd.setScalar(0),cd.fromBufferAttribute(e,t),ud.fromBufferAttribute(e,i),hd.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(cd,r.x),o.addScaledVector(ud,r.y),o.addScaledVector(hd,r.z),o}static isFrontFacing(e,t,i,s){return Bi.subVectors(i,t),bs.subVectors(e,t),Bi.cross(bs).dot(s)<0}set(e,t,i){return this.a.copy(e),this.b.copy(t),this.c.copy(i),this}setFromPointsAndIndices(e,t,i,s){return this.a.copy(e[t]),this.b.copy(e[i]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,i,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,i),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return Bi.subVectors(this.c,this.b),bs.subVectors(this.a,this.b),Bi.cross(bs).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return n.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return n.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,i,s,r){return n.getInterpolation(e,this.a,this.b,this.c,t,i,s,r)}containsPoint(e){return n.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return n.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let i=this.a,s=this.b,r=this.c,o,a;go.subVectors(s,i),_o.subVectors(r,i),od.subVectors(e,i);let c=go.dot(od),l=_o.dot(od);if(c<=0&&l<=0)return t.copy(i);ad.subVectors(e,s);let u=go.dot(ad),h=_o.dot(ad);if(u>=0&&h<=u)return t.copy(s);let f=c*h-u*l;if(f<=0&&c>=0&&u<=0&&c-u>0)return o=c/(c-u),t.copy(i).addScaledVector(go,o);ld.subVectors(e,r);let d=go.dot(ld),p=_o.dot(ld);if(p>=0&&d<=p)return t.copy(r);let S=d*l-c*p;if(S<=0&&l>=0&&p<=0)return a=l/(l-p),t.copy(i).addScaledVector(_o,a);let g=u*p-d*h;if(g<=0&&h-u>=0&&d-p>=0)return p_.subVectors(r,s),a=(h-u)/(h-u+(d-p)),t.copy(s).addScaledVector(p_,a);let m=1/(g+S+f);return o=S*m,a=f*m,t.copy(i).addScaledVector(go,o).addScaledVector(_o,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Ti=class{constructor(e=new W(1/0,1/0,1/0),t=new W(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t+=3)this.expandByPoint(ki.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,i=e.count;t<i;t++)this.expandByPoint(ki.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let i=ki.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(i),this.max.copy(e).add(i),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let i=e.geometry;if(i!==void 0){let r=i.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,ki):ki.fromBufferAttribute(r,o),ki.applyMatrix4(e.matrixWorld),this.expandByPoint(ki);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),_c.copy(e.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),_c.copy(i.boundingBox)),_c.applyMatrix4(e.matrixWorld),this.union(_c)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,ki),ki.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,i;return e.normal.x>0?(t=e.normal.x*this.min.x,i=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,i=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,i+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,i+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,i+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,i+=e.normal.z*this.min.z),t<=-e.constant&&i>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(Pa),yc.subVectors(this.max,Pa),yo.subVectors(e.a,Pa),xo.subVectors(e.b,Pa),vo.subVectors(e.c,Pa),Ys.subVectors(xo,yo),Ks.subVectors(vo,xo),vr.subVectors(yo,vo);let t=[0,-Ys.z,Ys.y,0,-Ks.z,Ks.y,0,-vr.z,vr.y,Ys.z,0,-Ys.x,Ks.z,0,-Ks.x,vr.z,0,-vr.x,-Ys.y,Ys.x,0,-Ks.y,Ks.x,0,-vr.y,vr.x,0];return!fd(t,yo,xo,vo,yc)||(t=[1,0,0,0,1,0,0,0,1],!fd(t,yo,xo,vo,yc))?!1:(xc.crossVectors(Ys,Ks),t=[xc.x,xc.y,xc.z],fd(t,yo,xo,vo,yc))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,ki).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(ki).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(Ms[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),Ms[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),Ms[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),Ms[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),Ms[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),Ms[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),Ms[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),Ms[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(Ms),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},Ms=[new W,new W,new W,new W,new W,new W,new W,new W],ki=new W,_c=new Ti,yo=new W,xo=new W,vo=new W,Ys=new W,Ks=new W,vr=new W,Pa=new W,yc=new W,xc=new W,br=new W;function fd(n,e,t,i,s){for(let r=0,o=n.length-3;r<=o;r+=3){br.fromArray(n,r);let a=s.x*Math.abs(br.x)+s.y*Math.abs(br.y)+s.z*Math.abs(br.z),c=e.dot(br),l=t.dot(br),u=i.dot(br);if(Math.max(-Math.max(c,l,u),Math.min(c,l,u))>a)return!1}return!0}var pn=new W,vc=new We,sE=0,mn=class extends Gi{constructor(e,t,i=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:sE++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=i,this.usage=$d,this.updateRanges=[],this.gpuType=Ai,this.version=0,this._normalizationScale=e!==void 0?th(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,i){e*=this.itemSize,i*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[i+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,i=this.count;t<i;t++)vc.fromBufferAttribute(this,t),vc.applyMatrix3(e),this.setXY(t,vc.x,vc.y);else if(this.itemSize===3)for(let t=0,i=this.count;t<i;t++)pn.fromBufferAttribute(this,t),pn.applyMatrix3(e),this.setXYZ(t,pn.x,pn.y,pn.z);return this}applyMatrix4(e){for(let t=0,i=this.count;t<i;t++)pn.fromBufferAttribute(this,t),pn.applyMatrix4(e),this.setXYZ(t,pn.x,pn.y,pn.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)pn.fromBufferAttribute(this,t),pn.applyNormalMatrix(e),this.setXYZ(t,pn.x,pn.y,pn.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)pn.fromBufferAttribute(this,t),pn.transformDirection(e),this.setXYZ(t,pn.x,pn.y,pn.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let i=this.array[e*this.itemSize+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.array[e*this.itemSize+t]=i,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,i){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.array[e+0]=t,this.array[e+1]=i,this}setXYZ(e,t,i,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):ep(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):tp(e,this.array)}};var qa=class extends mn{constructor(e,t,i){super(new Uint16Array(e),t,i)}};var $a=class extends mn{constructor(e,t,i){super(new Uint32Array(e),t,i)}};var vn=class extends mn{constructor(e,t,i){super(new Float32Array(e),t,i)}},rE=new Ti,Na=new W,dd=new W,qs=class{constructor(e=new W,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let i=this.center;t!==void 0?i.copy(t):rE.setFromPoints(e).getCenter(i);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,i.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let i=this.center.distanceToSquared(e);return t.copy(e),i>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;Na.subVectors(e,this.center);let t=Na.lengthSq();if(t>this.radius*this.radius){let i=Math.sqrt(t),s=(i-this.radius)*.5;this.center.addScaledVector(Na,s/i),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(dd.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(Na.copy(e.center).add(dd)),this.expandByPoint(Na.copy(e.center).sub(dd))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},oE=0,Mi=new Tt,pd=new Sn,bo=new W,fi=new Ti,La=new Ti,Nn=new W,Qn=class n extends Gi{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:oE++}),this.uuid=ar(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(PM(e)?$a:qa)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,i=0){this.groups.push({start:e,count:t,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new nt().getNormalMatrix(e);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Mi.makeRotationFromQuaternion(e),this.applyMatrix4(Mi),this}rotateX(e){return Mi.makeRotationX(e),this.applyMatrix4(Mi),this}rotateY(e){return Mi.makeRotationY(e),this.applyMatrix4(Mi),this}rotateZ(e){return Mi.makeRotationZ(e),this.applyMatrix4(Mi),this}translate(e,t,i){return Mi.makeTranslation(e,t,i),this.applyMatrix4(Mi),this}scale(e,t,i){return Mi.makeScale(e,t,i),this.applyMatrix4(Mi),this}lookAt(e){return pd.lookAt(e),pd.updateMatrix(),this.applyMatrix4(pd.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(bo).negate(),this.translate(bo.x,bo.y,bo.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let i=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new vn(i,3))}else{let i=Math.min(e.length,t.count);for(let s=0;s<i;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&qe("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Ti);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Qe("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new W(-1/0,-1/0,-1/0),new W(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let i=0,s=t.length;i<s;i++){let r=t[i];fi.setFromBufferAttribute(r),this.morphTargetsRelative?(Nn.addVectors(this.boundingBox.min,fi.min),this.boundingBox.expandByPoint(Nn),Nn.addVectors(this.boundingBox.max,fi.max),this.boundingBox.expandByPoint(Nn)):(this.boundingBox.expandByPoint(fi.min),this.boundingBox.expandByPoint(fi.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Qe('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new qs);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Qe("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new W,1/0);return}if(e){let i=this.boundingSphere.center;if(fi.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];La.setFromBufferAttribute(a),this.morphTargetsRelative?(Nn.addVectors(fi.min,La.min),fi.expandByPoint(Nn),Nn.addVectors(fi.max,La.max),fi.expandByPoint(Nn)):(fi.expandByPoint(La.min),fi.expandByPoint(La.max))}fi.getCenter(i);let s=0;for(let r=0,o=e.count;r<o;r++)Nn.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(Nn));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],c=this.morphTargetsRelative;for(let l=0,u=a.count;l<u;l++)Nn.fromBufferAttribute(a,l),c&&(bo.fromBufferAttribute(e,l),Nn.add(bo)),s=Math.max(s,i.distanceToSquared(Nn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Qe('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){Qe("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new mn(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],c=[],l=new Uint8Array(i.count);for(let F=0;F<i.count;F++)a[F]=new W,c[F]=new W;let u=new W,h=new W,f=new W,d=new We,p=new We,S=new We,g=new W,m=new W;function b(F,D,P){l[F]=l[D]=l[P]=1,u.fromBufferAttribute(i,F),h.fromBufferAttribute(i,D),f.fromBufferAttribute(i,P),d.fromBufferAttribute(r,F),p.fromBufferAttribute(r,D),S.fromBufferAttribute(r,P),h.sub(u),f.sub(u),p.sub(d),S.sub(d);let B=1/(p.x*S.y-S.x*p.y);isFinite(B)&&(g.copy(h).multiplyScalar(S.y).addScaledVector(f,-p.y).multiplyScalar(B),m.copy(f).multiplyScalar(p.x).addScaledVector(h,-S.x).multiplyScalar(B),a[F].add(g),a[D].add(g),a[P].add(g),c[F].add(m),c[D].add(m),c[P].add(m))}let I=this.groups;I.length===0&&(I=[{start:0,count:e.count}]);for(let F=0,D=I.length;F<D;++F){let P=I[F],B=P.start,G=P.count;for(let N=B,V=B+G;N<V;N+=3)b(e.getX(N+0),e.getX(N+1),e.getX(N+2))}let x=new W,w=new W,A=new W,_=new W;function T(F){A.fromBufferAttribute(s,F),_.copy(A);let D=a[F];x.copy(D),x.sub(A.multiplyScalar(A.dot(D))).normalize(),w.crossVectors(_,D);let B=w.dot(c[F])<0?-1:1;o.setXYZW(F,x.x,x.y,x.z,B)}for(let F=0,D=i.count;F<D;++F)l[F]&&T(F);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==t.count)i=new mn(new Float32Array(t.count*3),3),this.setAttribute("normal",i);else for(let f=0,d=i.count;f<d;f++)i.setXYZ(f,0,0,0);let s=new W,r=new W,o=new W,a=new W,c=new W,l=new W,u=new W,h=new W;if(e)for(let f=0,d=e.count;f<d;f+=3){let p=e.getX(f+0),S=e.getX(f+1),g=e.getX(f+2);s.fromBufferAttribute(t,p),r.fromBufferAttribute(t,S),o.fromBufferAttribute(t,g),u.subVectors(o,r),h.subVectors(s,r),u.cross(h),a.fromBufferAttribute(i,p),c.fromBufferAttribute(i,S),l.fromBufferAttribute(i,g),a.add(u),c.add(u),l.add(u),i.setXYZ(p,a.x,a.y,a.z),i.setXYZ(S,c.x,c.y,c.z),i.setXYZ(g,l.x,l.y,l.z)}else for(let f=0,d=t.count;f<d;f+=3)s.fromBufferAttribute(t,f+0),r.fromBufferAttribute(t,f+1),o.fromBufferAttribute(t,f+2),u.subVectors(o,r),h.subVectors(s,r),u.cross(h),i.setXYZ(f+0,u.x,u.y,u.z),i.setXYZ(f+1,u.x,u.y,u.z),i.setXYZ(f+2,u.x,u.y,u.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,i=e.count;t<i;t++)Nn.fromBufferAttribute(e,t),Nn.normalize(),e.setXYZ(t,Nn.x,Nn.y,Nn.z)}toNonIndexed(){function e(a,c){let l=a.array,u=a.itemSize,h=a.normalized,f=new l.constructor(c.length*u),d=0,p=0;for(let S=0,g=c.length;S<g;S++){a.isInterleavedBufferAttribute?d=c[S]*a.data.stride+a.offset:d=c[S]*u;for(let m=0;m<u;m++)f[p++]=l[d++]}return new mn(f,u,h)}if(this.index===null)return qe("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new n,i=this.index.array,s=this.attributes;for(let a in s){let c=s[a],l=e(c,i);t.setAttribute(a,l)}let r=this.morphAttributes;for(let a in r){let c=[],l=r[a];for(let u=0,h=l.length;u<h;u++){let f=l[u],d=e(f,i);c.push(d)}t.morphAttributes[a]=c}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,c=o.length;a<c;a++){let l=o[a];t.addGroup(l.start,l.count,l.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let c=this.parameters;for(let l in c)c[l]!==void 0&&(e[l]=c[l]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let i=this.attributes;for(let c in i){let l=i[c];e.data.attributes[c]=l.toJSON(e.data)}let s={},r=!1;for(let c in this.morphAttributes){let l=this.morphAttributes[c],u=[];for(let h=0,f=l.length;h<f;h++){let d=l[h];u.push(d.toJSON(e.data))}u.length>0&&(s[c]=u,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let i=e.index;i!==null&&this.setIndex(i.clone());let s=e.attributes;for(let l in s){let u=s[l];this.setAttribute(l,u.clone(t))}let r=e.morphAttributes;for(let l in r){let u=[],h=r[l];for(let f=0,d=h.length;f<d;f++)u.push(h[f].clone(t));this.morphAttributes[l]=u}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let l=0,u=o.length;l<u;l++){let h=o[l];this.addGroup(h.start,h.count,h.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let c=e.boundingSphere;return c!==null&&(this.boundingSphere=c.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},Ja=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=$d,this.updateRanges=[],this.version=0,this.uuid=ar()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,i){e*=this.stride,i*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[i+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=m_(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let i=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(i,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=m_(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function m_(n){return n.buffer._uuid===void 0&&(n.buffer._uuid=ar()),n.byteOffset===0&&n.byteLength===n.buffer.byteLength?n.buffer._uuid:n.buffer._uuid+":"+n.byteOffset+":"+n.byteLength}var Zn=new W,Fo=class n{constructor(e,t,i,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=i,this.normalized=s,this._normalizationScale=e!==void 0?th(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,i=this.data.count;t<i;t++)Zn.fromBufferAttribute(this,t),Zn.applyMatrix4(e),this.setXYZ(t,Zn.x,Zn.y,Zn.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)Zn.fromBufferAttribute(this,t),Zn.applyNormalMatrix(e),this.setXYZ(t,Zn.x,Zn.y,Zn.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)Zn.fromBufferAttribute(this,t),Zn.transformDirection(e),this.setXYZ(t,Zn.x,Zn.y,Zn.z);return this}getComponent(e,t){let i=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.data.array[e*this.data.stride+this.offset+t]=i,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,i){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.data.array[e+0]=t,this.data.array[e+1]=i,this}setXYZ(e,t,i,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=i,this.data.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=i,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){Ya("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new mn(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new n(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){Ya("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):ep(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):tp(e,this.data.array)}},md=new W,aE=new W,lE=new nt,$n=class{constructor(e=new W(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,i,s){return this.normal.set(e,t,i),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,i){let s=md.subVectors(i,t).cross(aE.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,i=!0){let s=e.delta(md),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),i=this.distanceToPoint(e.end);return t<0&&i>0||i<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let i=t||lE.getNormalMatrix(e),s=this.coplanarPoint(md).applyMatrix4(e),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},cE=0,ss=class extends Gi{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:cE++}),this.uuid=ar(),this.name="",this.type="Material",this.blending=Yo,this.side=rr,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Nd,this.blendDst=Ld,this.blendEquation=Nr,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new rt(0,0,0),this.blendAlpha=0,this.depthFunc=Po,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=iy,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=kc,this.stencilZFail=kc,this.stencilZPass=kc,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let i=e[t];if(i===void 0){qe(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){qe(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(e).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(e).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(e).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(e).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(e).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let o=[];for(let a in r){let c=r[a];delete c.metadata,o.push(c)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new rt().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(i=>new $n().fromJSON(i))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let i=e.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new We().fromArray(i)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new We().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,i=null;if(t!==null){let s=t.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=t[r].clone()}return this.clippingPlanes=i,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}},Bo=class extends ss{constructor(e){super(),this.isSpriteMaterial=!0,this.type="SpriteMaterial",this.color=new rt(16777215),this.map=null,this.alphaMap=null,this.rotation=0,this.sizeAttenuation=!0,this.transparent=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.rotation=e.rotation,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},So,Da=new W,Mo=new W,Eo=new W,To=new We,Ua=new We,py=new Tt,bc=new W,Oa=new W,Sc=new W,g_=new We,gd=new We,__=new We,Tr=class extends Sn{constructor(e=new Bo){if(super(),this.isSprite=!0,this.type="Sprite",So===void 0){So=new Qn;let t=new Float32Array([-.5,-.5,0,0,0,.5,-.5,0,1,0,.5,.5,0,1,1,-.5,.5,0,0,1]),i=new Ja(t,5);So.setIndex([0,1,2,0,2,3]),So.setAttribute("position",new Fo(i,3,0,!1)),So.setAttribute("uv",new Fo(i,2,3,!1))}this.geometry=So,this.material=e,this.center=new We(.5,.5),this.count=1}intersectsFrustum(e){return e.intersectsSprite(this)}raycast(e,t){e.camera===null&&Qe('Sprite: "Raycaster.camera" needs to be set in order to raycast against sprites.'),Mo.setFromMatrixScale(this.matrixWorld),py.copy(e.camera.matrixWorld),this.modelViewMatrix.multiplyMatrices(e.camera.matrixWorldInverse,this.matrixWorld),Eo.setFromMatrixPosition(this.modelViewMatrix),e.camera.isPerspectiveCamera&&this.material.sizeAttenuation===!1&&Mo.multiplyScalar(-Eo.z);let i=this.material.rotation,s,r;i!==0&&(r=Math.cos(i),s=Math.sin(i));let o=this.center;Mc(bc.set(-.5,-.5,0),Eo,o,Mo,s,r),Mc(Oa.set(.5,-.5,0),Eo,o,Mo,s,r),Mc(Sc.set(.5,.5,0),Eo,o,Mo,s,r),g_.set(0,0),gd.set(1,0),__.set(1,1);let a=e.ray.intersectTriangle(bc,Oa,Sc,!1,Da);if(a===null&&(Mc(Oa.set(-.5,.5,0),Eo,o,Mo,s,r),gd.set(0,1),a=e.ray.intersectTriangle(bc,Sc,Oa,!1,Da),a===null))return;let c=e.ray.origin.distanceTo(Da);c<e.near||c>e.far||t.push({distance:c,point:Da.clone(),uv:Ts.getInterpolation(Da,bc,Oa,Sc,g_,gd,__,new We),face:null,object:this})}copy(e,t){return super.copy(e,t),e.center!==void 0&&this.center.copy(e.center),this.material=e.material,this}toJSON(e){let t=super.toJSON(e);return t.object.center=this.center.toArray(),t}};function Mc(n,e,t,i,s,r){To.subVectors(n,t).addScalar(.5).multiply(i),s!==void 0?(Ua.x=r*To.x-s*To.y,Ua.y=s*To.x+r*To.y):Ua.copy(To),n.copy(e),n.x+=Ua.x,n.y+=Ua.y,n.applyMatrix4(py)}var Es=new W,_d=new W,Ec=new W,Tc=new W,ko=class{constructor(e=new W,t=new W(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,Es)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let i=t.dot(this.direction);return i<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=Es.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(Es.copy(this.origin).addScaledVector(this.direction,t),Es.distanceToSquared(e))}distanceSqToSegment(e,t,i,s){_d.copy(e).add(t).multiplyScalar(.5),Ec.copy(t).sub(e).normalize(),Tc.copy(this.origin).sub(_d);let r=e.distanceTo(t)*.5,o=-this.direction.dot(Ec),a=Tc.dot(this.direction),c=-Tc.dot(Ec),l=Tc.lengthSq(),u=Math.abs(1-o*o),h,f,d,p;if(u>0)if(h=o*c-a,f=o*a-c,p=r*u,h>=0)if(f>=-p)if(f<=p){let S=1/u;h*=S,f*=S,d=h*(h+o*f+2*a)+f*(o*h+f+2*c)+l}else f=r,h=Math.max(0,-(o*f+a)),d=-h*h+f*(f+2*c)+l;else f=-r,h=Math.max(0,-(o*f+a)),d=-h*h+f*(f+2*c)+l;else f<=-p?(h=Math.max(0,-(-o*r+a)),f=h>0?-r:Math.min(Math.max(-r,-c),r),d=-h*h+f*(f+2*c)+l):f<=p?(h=0,f=Math.min(Math.max(-r,-c),r),d=f*(f+2*c)+l):(h=Math.max(0,-(o*r+a)),f=h>0?r:Math.min(Math.max(-r,-c),r),d=-h*h+f*(f+2*c)+l);else f=o>0?-r:r,h=Math.max(0,-(o*f+a)),d=-h*h+f*(f+2*c)+l;return i&&i.copy(this.origin).addScaledVector(this.direction,h),s&&s.copy(_d).addScaledVector(Ec,f),d}intersectSphere(e,t){if(e.radius<0)return null;Es.subVectors(e.center,this.origin);let i=Es.dot(this.direction),s=Es.dot(Es)-i*i,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=i-o,c=i+o;return c<0?null:a<0?this.at(c,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(e.normal)+e.constant)/t;return i>=0?i:null}intersectPlane(e,t){let i=this.distanceToPlane(e);return i===null?null:this.at(i,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let i,s,r,o,a,c,l=1/this.direction.x,u=1/this.direction.y,h=1/this.direction.z,f=this.origin;return l>=0?(i=(e.min.x-f.x)*l,s=(e.max.x-f.x)*l):(i=(e.max.x-f.x)*l,s=(e.min.x-f.x)*l),u>=0?(r=(e.min.y-f.y)*u,o=(e.max.y-f.y)*u):(r=(e.max.y-f.y)*u,o=(e.min.y-f.y)*u),i>o||r>s||((r>i||isNaN(i))&&(i=r),(o<s||isNaN(s))&&(s=o),h>=0?(a=(e.min.z-f.z)*h,c=(e.max.z-f.z)*h):(a=(e.max.z-f.z)*h,c=(e.min.z-f.z)*h),i>c||a>s)||((a>i||i!==i)&&(i=a),(c<s||s!==s)&&(s=c),s<0)?null:this.at(i>=0?i:s,t)}intersectsBox(e){return this.intersectBox(e,Es)!==null}intersectTriangle(e,t,i,s,r){let o=this.origin,a=this.direction,c=a.x,l=a.y,u=a.z,h=e.x-o.x,f=e.y-o.y,d=e.z-o.z,p=t.x-o.x,S=t.y-o.y,g=t.z-o.z,m=i.x-o.x,b=i.y-o.y,I=i.z-o.z,x=Math.abs(c),w=Math.abs(l),A=Math.abs(u),_,T,F,D,P,B,G,N,V,Y,z,le;if(x>=w&&x>=A?(F=c,B=h,V=p,le=m,c>=0?(_=l,T=u,D=f,P=d,G=S,N=g,Y=b,z=I):(_=u,T=l,D=d,P=f,G=g,N=S,Y=I,z=b)):w>=A?(F=l,B=f,V=S,le=b,l>=0?(_=u,T=c,D=d,P=h,G=g,N=p,Y=I,z=m):(_=c,T=u,D=h,P=d,G=p,N=g,Y=m,z=I)):(F=u,B=d,V=g,le=I,u>=0?(_=c,T=l,D=h,P=f,G=p,N=S,Y=m,z=b):(_=l,T=c,D=f,P=h,G=S,N=p,Y=b,z=m)),F===0)return null;let q=_/F,j=T/F,te=1/F,fe=D-q*B,he=P-j*B,ee=G-q*V,me=N-j*V,ye=Y-q*le,we=z-j*le,Se=ye*me-we*ee,Xe=fe*we-he*ye,ot=ee*he-me*fe;if(s){if(Se<0||Xe<0||ot<0)return null}else if((Se<0||Xe<0||ot<0)&&(Se>0||Xe>0||ot>0))return null;let Ve=Se+Xe+ot;if(Ve===0)return null;let ft=te*(Se*B+Xe*V+ot*le);return(Ve>0?ft<0:ft>0)?null:this.at(ft/Ve,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},$s=class extends ss{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new rt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new is,this.combine=pu,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},y_=new Tt,Sr=new ko,Ac=new qs,x_=new W,wc=new W,Rc=new W,Ic=new W,yd=new W,Cc=new W,v_=new W,Pc=new W,Ct=class extends Sn{constructor(e=new Qn,t=new $s){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){Cc.set(0,0,0);for(let c=0,l=r.length;c<l;c++){let u=a[c],h=r[c];u!==0&&(yd.fromBufferAttribute(h,e),o?Cc.addScaledVector(yd,u):Cc.addScaledVector(yd.sub(t),u))}t.add(Cc)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),Ac.copy(i.boundingSphere),Ac.applyMatrix4(r),Sr.copy(e.ray).recast(e.near),!(Ac.containsPoint(Sr.origin)===!1&&(Sr.intersectSphere(Ac,x_)===null||Sr.origin.distanceToSquared(x_)>(e.far-e.near)**2))&&(y_.copy(r).invert(),Sr.copy(e.ray).applyMatrix4(y_),!(i.boundingBox!==null&&Sr.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(e,t,Sr)))}_computeIntersections(e,t,i){let s,r=this.geometry,o=this.material,a=r.index,c=r.attributes.position,l=r.attributes.uv,u=r.attributes.uv1,h=r.attributes.normal,f=r.groups,d=r.drawRange;if(a!==null)if(Array.isArray(o))for(let p=0,S=f.length;p<S;p++){let g=f[p],m=o[g.materialIndex],b=Math.max(g.start,d.start),I=Math.min(a.count,Math.min(g.start+g.count,d.start+d.count));for(let x=b,w=I;x<w;x+=3){let A=a.getX(x),_=a.getX(x+1),T=a.getX(x+2);s=Nc(this,m,e,i,l,u,h,A,_,T),s&&(s.faceIndex=Math.floor(x/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let p=Math.max(0,d.start),S=Math.min(a.count,d.start+d.count);for(let g=p,m=S;g<m;g+=3){let b=a.getX(g),I=a.getX(g+1),x=a.getX(g+2);s=Nc(this,o,e,i,l,u,h,b,I,x),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}else if(c!==void 0)if(Array.isArray(o))for(let p=0,S=f.length;p<S;p++){let g=f[p],m=o[g.materialIndex],b=Math.max(g.start,d.start),I=Math.min(c.count,Math.min(g.start+g.count,d.start+d.count));for(let x=b,w=I;x<w;x+=3){let A=x,_=x+1,T=x+2;s=Nc(this,m,e,i,l,u,h,A,_,T),s&&(s.faceIndex=Math.floor(x/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let p=Math.max(0,d.start),S=Math.min(c.count,d.start+d.count);for(let g=p,m=S;g<m;g+=3){let b=g,I=g+1,x=g+2;s=Nc(this,o,e,i,l,u,h,b,I,x),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}}};function uE(n,e,t,i,s,r,o,a){let c;if(e.side===Mn?c=i.intersectTriangle(o,r,s,!0,a):c=i.intersectTriangle(s,r,o,e.side===rr,a),c===null)return null;Pc.copy(a),Pc.applyMatrix4(n.matrixWorld);let l=t.ray.origin.distanceTo(Pc);return l<t.near||l>t.far?null:{distance:l,point:Pc.clone(),object:n}}function Nc(n,e,t,i,s,r,o,a,c,l){n.getVertexPosition(a,wc),n.getVertexPosition(c,Rc),n.getVertexPosition(l,Ic);let u=uE(n,e,t,i,wc,Rc,Ic,v_);if(u){let h=new W;Ts.getBarycoord(v_,wc,Rc,Ic,h),s&&(u.uv=Ts.getInterpolatedAttribute(s,a,c,l,h,new We)),r&&(u.uv1=Ts.getInterpolatedAttribute(r,a,c,l,h,new We)),o&&(u.normal=Ts.getInterpolatedAttribute(o,a,c,l,h,new W),u.normal.dot(i.direction)>0&&u.normal.multiplyScalar(-1));let f={a,b:c,c:l,normal:new W,materialIndex:0};Ts.getNormal(wc,Rc,Ic,f.normal),u.face=f,u.barycoord=h}return u}var Ar=class extends jn{constructor(e=null,t=1,i=1,s,r,o,a,c,l=Ln,u=Ln,h,f){super(null,o,a,c,l,u,s,r,h,f),this.isDataTexture=!0,this.image={data:e,width:t,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Go=class extends mn{constructor(e,t,i,s=1){super(e,t,i),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}toJSON(){let e=super.toJSON();return e.meshPerAttribute=this.meshPerAttribute,e.isInstancedBufferAttribute=!0,e}},Ao=new Tt,b_=new Tt,Lc=[],S_=new Ti,hE=new Tt,Fa=new Ct,Ba=new qs,Js=class extends Ct{constructor(e,t,i){super(e,t),this.isInstancedMesh=!0,this.instanceMatrix=new Go(new Float32Array(i*16),16),this.instanceColor=null,this.morphTexture=null,this.count=i,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<i;s++)this.setMatrixAt(s,hE)}computeBoundingBox(){let e=this.geometry,t=this.count;this.boundingBox===null&&(this.boundingBox=new Ti),e.boundingBox===null&&e.computeBoundingBox(),this.boundingBox.makeEmpty();for(let i=0;i<t;i++)this.getMatrixAt(i,Ao),S_.copy(e.boundingBox).applyMatrix4(Ao),this.boundingBox.union(S_)}computeBoundingSphere(){let e=this.geometry,t=this.count;this.boundingSphere===null&&(this.boundingSphere=new qs),e.boundingSphere===null&&e.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let i=0;i<t;i++)this.getMatrixAt(i,Ao),Ba.copy(e.boundingSphere).applyMatrix4(Ao),this.boundingSphere.union(Ba)}copy(e,t){return super.copy(e,t),this.instanceMatrix.copy(e.instanceMatrix),this.morphTexture=e.morphTexture!==null?e.morphTexture.clone():null,this.instanceColor=e.instanceColor!==null?e.instanceColor.clone():null,this.count=e.count,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this}getColorAt(e,t){return this.instanceColor===null?t.setRGB(1,1,1):t.fromArray(this.instanceColor.array,e*3)}getMatrixAt(e,t){return t.fromArray(this.instanceMatrix.array,e*16)}getMorphAt(e,t){let i=t.morphTargetInfluences,s=this.morphTexture.source.data.data,r=i.length+1,o=e*r+1;for(let a=0;a<i.length;a++)i[a]=s[o+a]}raycast(e,t){let i=this.matrixWorld,s=this.count;if(Fa.geometry=this.geometry,Fa.material=this.material,Fa.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),Ba.copy(this.boundingSphere),Ba.applyMatrix4(i),e.ray.intersectsSphere(Ba)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,Ao),b_.multiplyMatrices(i,Ao),Fa.matrixWorld=b_,Fa.raycast(e,Lc);for(let o=0,a=Lc.length;o<a;o++){let c=Lc[o];c.instanceId=r,c.object=this,t.push(c)}Lc.length=0}}setColorAt(e,t){return this.instanceColor===null&&(this.instanceColor=new Go(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),t.toArray(this.instanceColor.array,e*3),this}setMatrixAt(e,t){return t.toArray(this.instanceMatrix.array,e*16),this}setMorphAt(e,t){let i=t.morphTargetInfluences,s=i.length+1;this.morphTexture===null&&(this.morphTexture=new Ar(new Float32Array(s*this.count),s,this.count,bu,Ai));let r=this.morphTexture.source.data.data,o=0;for(let l=0;l<i.length;l++)o+=i[l];let a=this.geometry.morphTargetsRelative?1:1-o,c=s*e;return r[c]=a,r.set(i,c+1),this}updateMorphTargets(){}dispose(){super.dispose(),this.instanceMatrix.dispose(),this.instanceColor!==null&&this.instanceColor.dispose(),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null)}},Mr=new qs,fE=new We(.5,.5),Dc=new W,js=class{constructor(e=new $n,t=new $n,i=new $n,s=new $n,r=new $n,o=new $n){this.planes=[e,t,i,s,r,o]}set(e,t,i,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(i),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let i=0;i<6;i++)t[i].copy(e.planes[i]);return this}setFromProjectionMatrix(e,t=Ei,i=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],c=r[2],l=r[3],u=r[4],h=r[5],f=r[6],d=r[7],p=r[8],S=r[9],g=r[10],m=r[11],b=r[12],I=r[13],x=r[14],w=r[15];if(s[0].setComponents(l-o,d-u,m-p,w-b).normalize(),s[1].setComponents(l+o,d+u,m+p,w+b).normalize(),s[2].setComponents(l+a,d+h,m+S,w+I).normalize(),s[3].setComponents(l-a,d-h,m-S,w-I).normalize(),i)s[4].setComponents(c,f,g,x).normalize(),s[5].setComponents(l-c,d-f,m-g,w-x).normalize();else if(s[4].setComponents(l-c,d-f,m-g,w-x).normalize(),t===Ei)s[5].setComponents(l+c,d+f,m+g,w+x).normalize();else if(t===No)s[5].setComponents(c,f,g,x).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Mr.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Mr.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Mr)}intersectsSprite(e){Mr.center.set(0,0,0);let t=fE.distanceTo(e.center);return Mr.radius=.7071067811865476+t,Mr.applyMatrix4(e.matrixWorld),this.intersectsSphere(Mr)}intersectsSphere(e){let t=this.planes,i=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let i=0;i<6;i++){let s=t[i];if(Dc.x=s.normal.x>0?e.max.x:e.min.x,Dc.y=s.normal.y>0?e.max.y:e.min.y,Dc.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(Dc)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let i=0;i<6;i++)if(t[i].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},M_=new Tt,Qc=class n{constructor(){this.coordinateSystem=Ei,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,i=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];M_.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new js),i[s].setFromProjectionMatrix(M_,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,i=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new js),t[s].copy(i[s]);return this._count=e._count,this}clone(){return new n().copy(this)}};var ja=class extends jn{constructor(e=[],t=Lr,i,s,r,o,a,c,l,u){super(e,t,i,s,r,o,a,c,l,u),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},Qa=class extends jn{constructor(e,t,i,s,r,o,a,c,l){super(e,t,i,s,r,o,a,c,l),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Rs=class extends jn{constructor(e,t,i=zi,s,r,o,a=Ln,c=Ln,l,u=ws,h=1){if(u!==ws&&u!==Cs)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let f={width:e,height:t,depth:h};super(f,s,r,o,a,c,u,i,l),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new Uo(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},el=class extends Rs{constructor(e,t=zi,i=Lr,s,r,o=Ln,a=Ln,c,l=ws){let u={width:e,height:e,depth:1},h=[u,u,u,u,u,u];super(e,e,t,i,s,r,o,a,c,l),this.image=h,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},tl=class extends jn{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},Qs=class n extends Qn{constructor(e=1,t=1,i=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:i,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let c=[],l=[],u=[],h=[],f=0,d=0;p("z","y","x",-1,-1,i,t,e,o,r,0),p("z","y","x",1,-1,i,t,-e,o,r,1),p("x","z","y",1,1,e,i,t,s,o,2),p("x","z","y",1,-1,e,i,-t,s,o,3),p("x","y","z",1,-1,e,t,i,s,r,4),p("x","y","z",-1,-1,e,t,-i,s,r,5),this.setIndex(c),this.setAttribute("position",new vn(l,3)),this.setAttribute("normal",new vn(u,3)),this.setAttribute("uv",new vn(h,2));function p(S,g,m,b,I,x,w,A,_,T,F){let D=x/_,P=w/T,B=x/2,G=w/2,N=A/2,V=_+1,Y=T+1,z=0,le=0,q=new W;for(let j=0;j<Y;j++){let te=j*P-G;for(let fe=0;fe<V;fe++){let he=fe*D-B;q[S]=he*b,q[g]=te*I,q[m]=N,l.push(q.x,q.y,q.z),q[S]=0,q[g]=0,q[m]=A>0?1:-1,u.push(q.x,q.y,q.z),h.push(fe/_),h.push(1-j/T),z+=1}}for(let j=0;j<T;j++)for(let te=0;te<_;te++){let fe=f+te+V*j,he=f+te+V*(j+1),ee=f+(te+1)+V*(j+1),me=f+(te+1)+V*j;c.push(fe,he,me),c.push(he,ee,me),le+=6}a.addGroup(d,le,F),d+=le,f+=z}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}};var zo=class n extends Qn{constructor(e=1,t=1,i=1,s=32,r=1,o=!1,a=0,c=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:i,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:c};let l=this;s=Math.floor(s),r=Math.floor(r);let u=[],h=[],f=[],d=[],p=0,S=[],g=i/2,m=0;b(),o===!1&&(e>0&&I(!0),t>0&&I(!1)),this.setIndex(u),this.setAttribute("position",new vn(h,3)),this.setAttribute("normal",new vn(f,3)),this.setAttribute("uv",new vn(d,2));function b(){let x=new W,w=new W,A=0,_=(t-e)/i;for(let T=0;T<=r;T++){let F=[],D=T/r,P=D*(t-e)+e;for(let B=0;B<=s;B++){let G=B/s,N=G*c+a,V=Math.sin(N),Y=Math.cos(N);w.x=P*V,w.y=-D*i+g,w.z=P*Y,h.push(w.x,w.y,w.z),x.set(V,_,Y).normalize(),f.push(x.x,x.y,x.z),d.push(G,1-D),F.push(p++)}S.push(F)}for(let T=0;T<s;T++)for(let F=0;F<r;F++){let D=S[F][T],P=S[F+1][T],B=S[F+1][T+1],G=S[F][T+1];(e>0||F!==0)&&(u.push(D,P,G),A+=3),(t>0||F!==r-1)&&(u.push(P,B,G),A+=3)}l.addGroup(m,A,0),m+=A}function I(x){let w=p,A=new We,_=new W,T=0,F=x===!0?e:t,D=x===!0?1:-1;for(let B=1;B<=s;B++)h.push(0,g*D,0),f.push(0,D,0),d.push(.5,.5),p++;let P=p;for(let B=0;B<=s;B++){let N=B/s*c+a,V=Math.cos(N),Y=Math.sin(N);_.x=F*Y,_.y=g*D,_.z=F*V,h.push(_.x,_.y,_.z),f.push(0,D,0),A.x=V*.5+.5,A.y=Y*.5*D+.5,d.push(A.x,A.y),p++}for(let B=0;B<s;B++){let G=w+B,N=P+B;x===!0?u.push(N,N+1,G):u.push(N+1,N,G),T+=3}l.addGroup(m,T,x===!0?1:2),m+=T}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},nl=class n extends zo{constructor(e=1,t=1,i=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,i,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:i,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new n(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var wr=class n extends Qn{constructor(e=1,t=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:i,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(i),c=Math.floor(s),l=a+1,u=c+1,h=e/a,f=t/c,d=[],p=[],S=[],g=[];for(let m=0;m<u;m++){let b=m*f-o;for(let I=0;I<l;I++){let x=I*h-r;p.push(x,-b,0),S.push(0,0,1),g.push(I/a),g.push(1-m/c)}}for(let m=0;m<c;m++)for(let b=0;b<a;b++){let I=b+l*m,x=b+l*(m+1),w=b+1+l*(m+1),A=b+1+l*m;d.push(I,x,A),d.push(x,w,A)}this.setIndex(d),this.setAttribute("position",new vn(p,3)),this.setAttribute("normal",new vn(S,3)),this.setAttribute("uv",new vn(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.widthSegments,e.heightSegments)}};var Rr=class n extends Qn{constructor(e=1,t=32,i=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:i,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),i=Math.max(2,Math.floor(i));let c=Math.min(o+a,Math.PI),l=0,u=[],h=new W,f=new W,d=[],p=[],S=[],g=[];for(let m=0;m<=i;m++){let b=[],I=m/i,x=o+I*a,w=e*Math.cos(x),A=Math.sqrt(e*e-w*w),_=0;m===0&&o===0?_=.5/t:m===i&&c===Math.PI&&(_=-.5/t);for(let T=0;T<=t;T++){let F=T/t,D=s+F*r;h.x=-A*Math.cos(D),h.y=w,h.z=A*Math.sin(D),p.push(h.x,h.y,h.z),f.copy(h).normalize(),S.push(f.x,f.y,f.z),g.push(F+_,1-I),b.push(l++)}u.push(b)}for(let m=0;m<i;m++)for(let b=0;b<t;b++){let I=u[m][b+1],x=u[m][b],w=u[m+1][b],A=u[m+1][b+1];(m!==0||o>0)&&d.push(I,x,A),(m!==i-1||c<Math.PI)&&d.push(x,w,A)}this.setIndex(d),this.setAttribute("position",new vn(p,3)),this.setAttribute("normal",new vn(S,3)),this.setAttribute("uv",new vn(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};function Ur(n){let e={};for(let t in n){e[t]={};for(let i in n[t]){let s=n[t][i];if(E_(s))s.isRenderTargetTexture?(qe("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][i]=null):e[t][i]=s.clone();else if(Array.isArray(s))if(E_(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][i]=r}else e[t][i]=s.slice();else e[t][i]=s}}return e}function zn(n){let e={};for(let t=0;t<n.length;t++){let i=Ur(n[t]);for(let s in i)e[s]=i[s]}return e}function E_(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function dE(n){let e=[];for(let t=0;t<n.length;t++)e.push(n[t].clone());return e}function np(n){let e=n.getRenderTarget();return e===null?n.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:xt.workingColorSpace}var my={clone:Ur,merge:zn},pE=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,mE=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,rs=class extends ss{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=pE,this.fragmentShader=mE,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=Ur(e.uniforms),this.uniformsGroups=dE(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(t.extensions=i),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let i in e.uniforms){let s=e.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=t[s.value]||null;break;case"c":this.uniforms[i].value=new rt().setHex(s.value);break;case"v2":this.uniforms[i].value=new We().fromArray(s.value);break;case"v3":this.uniforms[i].value=new W().fromArray(s.value);break;case"v4":this.uniforms[i].value=new qt().fromArray(s.value);break;case"m3":this.uniforms[i].value=new nt().fromArray(s.value);break;case"m4":this.uniforms[i].value=new Tt().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let i in e.extensions)this.extensions[i]=e.extensions[i];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},eu=class extends rs{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}},pi=class extends ss{constructor(e){super(),this.isMeshStandardMaterial=!0,this.type="MeshStandardMaterial",this.defines={STANDARD:""},this.color=new rt(16777215),this.roughness=1,this.metalness=0,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new rt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=xl,this.normalScale=new We(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.roughnessMap=null,this.metalnessMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new is,this.envMapIntensity=1,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.defines={STANDARD:""},this.color.copy(e.color),this.roughness=e.roughness,this.metalness=e.metalness,this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.roughnessMap=e.roughnessMap,this.metalnessMap=e.metalnessMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.envMapIntensity=e.envMapIntensity,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}};var Ir=class extends ss{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new rt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new rt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=xl,this.normalScale=new We(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new is,this.combine=pu,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},tu=class extends ss{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=ty,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},nu=class extends ss{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function wo(n,e){return!n||n.constructor===e?n:typeof e.BYTES_PER_ELEMENT=="number"?new e(n):Array.prototype.slice.call(n)}function Uc(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var er=class{constructor(e,t,i,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(i),this.sampleValues=t,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,i=this._cachedIndex,s=t[i],r=t[i-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=i+2;;){if(s===void 0){if(e<r)break i;return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=s,s=t[++i],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(i=2,r=a);for(let c=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===c)break;if(s=r,r=t[--i-1],e>=r)break e}o=i,i=0;break t}break n}for(;i<o;){let a=i+o>>>1;e<t[a]?o=a:i=a+1}if(s=t[i],r=t[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=i[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},iu=class extends er{constructor(e,t,i,s){super(e,t,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:bd,endingEnd:bd}}intervalChanged_(e,t,i){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],c=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case Sd:r=e,a=2*t-i;break;case Md:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=i}if(c===void 0)switch(this.getSettings_().endingEnd){case Sd:o=e,c=2*i-t;break;case Md:o=1,c=i+s[1]-s[0];break;default:o=e-1,c=t}let l=(i-t)*.5,u=this.valueSize;this._weightPrev=l/(t-a),this._weightNext=l/(c-i),this._offsetPrev=r*u,this._offsetNext=o*u}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=e*a,l=c-a,u=this._offsetPrev,h=this._offsetNext,f=this._weightPrev,d=this._weightNext,p=(i-t)/(s-t),S=p*p,g=S*p,m=-f*g+2*f*S-f*p,b=(1+f)*g+(-1.5-2*f)*S+(-.5+f)*p+1,I=(-1-d)*g+(1.5+d)*S+.5*p,x=d*g-d*S;for(let w=0;w!==a;++w)r[w]=m*o[u+w]+b*o[l+w]+I*o[c+w]+x*o[h+w];return r}},su=class extends er{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=e*a,l=c-a,u=(i-t)/(s-t),h=1-u;for(let f=0;f!==a;++f)r[f]=o[l+f]*h+o[c+f]*u;return r}},ru=class extends er{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e){return this.copySampleValue_(e-1)}},ou=class extends er{interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=e*a,l=c-a,u=this.inTangents,h=this.outTangents;if(!u||!h){let p=(i-t)/(s-t),S=1-p;for(let g=0;g!==a;++g)r[g]=o[l+g]*S+o[c+g]*p;return r}let f=a*2,d=e-1;for(let p=0;p!==a;++p){let S=o[l+p],g=o[c+p],m=d*f+p*2,b=h[m],I=h[m+1],x=e*f+p*2,w=u[x],A=u[x+1],_=_E(i,t,b,w,s);r[p]=gy(_,S,I,A,g)}return r}};function gy(n,e,t,i,s){let r=1-n;return r*r*r*e+3*r*r*n*t+3*r*n*n*i+n*n*n*s}function gE(n,e,t,i,s){let r=1-n;return 3*r*r*(t-e)+6*r*n*(i-t)+3*n*n*(s-i)}function _E(n,e,t,i,s){let r=(n-e)/(s-e);for(let o=0;o<8;o++){let a=gy(r,e,t,i,s)-n;if(Math.abs(a)<1e-10)break;let c=gE(r,e,t,i,s);if(Math.abs(c)<1e-10)break;r=Math.max(0,Math.min(1,r-a/c))}return r}var mi=class{constructor(e,t,i,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=wo(t,this.TimeBufferType),this.values=wo(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,i;if(t.toJSON!==this.toJSON)i=t.toJSON(e);else{i={name:e.name,times:wo(e.times,Array),values:wo(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(i.interpolation=s),Uc(e.settings)&&(i.settings={inTangents:wo(e.settings.inTangents,Array),outTangents:wo(e.settings.outTangents,Array)})}return i.type=e.ValueTypeName,i}InterpolantFactoryMethodDiscrete(e){return new ru(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new su(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new iu(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new ou(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case Va:t=this.InterpolantFactoryMethodDiscrete;break;case qc:t=this.InterpolantFactoryMethodLinear;break;case Bc:t=this.InterpolantFactoryMethodSmooth;break;case vd:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return qe("KeyframeTrack:",i),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Va;case this.InterpolantFactoryMethodLinear:return qc;case this.InterpolantFactoryMethodSmooth:return Bc;case this.InterpolantFactoryMethodBezier:return vd}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]+=e;Uc(this.settings)&&(T_(this.settings.inTangents,e),T_(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]*=e;Uc(this.settings)&&(A_(this.settings.inTangents,e),A_(this.settings.outTangents,e))}return this}trim(e,t){let i=this.times,s=i.length,r=0,o=s-1;for(;r!==s&&i[r]<e;)++r;for(;o!==-1&&i[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(Qe("KeyframeTrack: Invalid value size in track.",this),e=!1);let i=this.times,s=this.values,r=i.length;r===0&&(Qe("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let c=i[a];if(typeof c=="number"&&isNaN(c)){Qe("KeyframeTrack: Time is not a valid number.",this,a,c),e=!1;break}if(o!==null&&o>c){Qe("KeyframeTrack: Out of order keys.",this,a,c,o),e=!1;break}o=c}if(s!==void 0&&NM(s))for(let a=0,c=s.length;a!==c;++a){let l=s[a];if(isNaN(l)){Qe("KeyframeTrack: Value is not a valid number.",this,a,l),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===Bc,r=e.length-1,o=1;for(let a=1;a<r;++a){let c=!1,l=e[a],u=e[a+1];if(l!==u&&(a!==1||l!==e[0]))if(s)c=!0;else{let h=a*i,f=h-i,d=h+i;for(let p=0;p!==i;++p){let S=t[h+p];if(S!==t[f+p]||S!==t[d+p]){c=!0;break}}}if(c){if(a!==o){e[o]=e[a];let h=a*i,f=o*i;for(let d=0;d!==i;++d)t[f+d]=t[h+d]}++o}}if(r>0){e[o]=e[r];for(let a=r*i,c=o*i,l=0;l!==i;++l)t[c+l]=t[a+l];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*i)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),i=this.constructor,s=new i(this.name,e,t);return s.createInterpolant=this.createInterpolant,Uc(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function T_(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]+=e}function A_(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]*=e}mi.prototype.ValueTypeName="";mi.prototype.TimeBufferType=Float32Array;mi.prototype.ValueBufferType=Float32Array;mi.prototype.DefaultInterpolation=qc;var tr=class extends mi{constructor(e,t,i){super(e,t,i)}};tr.prototype.ValueTypeName="bool";tr.prototype.ValueBufferType=Array;tr.prototype.DefaultInterpolation=Va;tr.prototype.InterpolantFactoryMethodLinear=void 0;tr.prototype.InterpolantFactoryMethodSmooth=void 0;var au=class extends mi{constructor(e,t,i,s){super(e,t,i,s)}};au.prototype.ValueTypeName="color";var lu=class extends mi{constructor(e,t,i,s){super(e,t,i,s)}};lu.prototype.ValueTypeName="number";var cu=class extends er{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=(i-t)/(s-t),l=e*a;for(let u=l+a;l!==u;l+=4)bn.slerpFlat(r,0,o,l-a,o,l,c);return r}},il=class extends mi{constructor(e,t,i,s){super(e,t,i,s)}InterpolantFactoryMethodLinear(e){return new cu(this.times,this.values,this.getValueSize(),e)}};il.prototype.ValueTypeName="quaternion";il.prototype.InterpolantFactoryMethodSmooth=void 0;var nr=class extends mi{constructor(e,t,i){super(e,t,i)}};nr.prototype.ValueTypeName="string";nr.prototype.ValueBufferType=Array;nr.prototype.DefaultInterpolation=Va;nr.prototype.InterpolantFactoryMethodLinear=void 0;nr.prototype.InterpolantFactoryMethodSmooth=void 0;var uu=class extends mi{constructor(e,t,i,s){super(e,t,i,s)}};uu.prototype.ValueTypeName="vector";var hu=class{constructor(e,t,i){let s=this,r=!1,o=0,a=0,c,l=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=i,this._abortController=null,this.itemStart=function(u){a++,r===!1&&s.onStart!==void 0&&s.onStart(u,o,a),r=!0},this.itemEnd=function(u){o++,s.onProgress!==void 0&&s.onProgress(u,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(u){s.onError!==void 0&&s.onError(u)},this.resolveURL=function(u){return u=u.normalize("NFC"),c?c(u):u},this.setURLModifier=function(u){return c=u,this},this.addHandler=function(u,h){return l.push(u,h),this},this.removeHandler=function(u){let h=l.indexOf(u);return h!==-1&&l.splice(h,2),this},this.getHandler=function(u){for(let h=0,f=l.length;h<f;h+=2){let d=l[h],p=l[h+1];if(d.global&&(d.lastIndex=0),d.test(u))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},_y=new hu,fu=class{constructor(e){this.manager=e!==void 0?e:_y,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let i=this;return new Promise(function(s,r){i.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};fu.DEFAULT_MATERIAL_NAME="__DEFAULT";var Vo=class extends Sn{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new rt(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},sl=class extends Vo{constructor(e,t,i){super(e,i),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(Sn.DEFAULT_UP),this.updateMatrix(),this.groundColor=new rt(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},xd=new Tt,w_=new W,R_=new W,rl=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new We(512,512),this.mapType=ti,this.map=null,this.mapPass=null,this.matrix=new Tt,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new js,this._frameExtents=new We(1,1),this._viewportCount=1,this._viewports=[new qt(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;w_.setFromMatrixPosition(e.matrixWorld),t.position.copy(w_),R_.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(R_),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,i,s){xd.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),i.setFromProjectionMatrix(xd,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,c=s?s.x/r.x:0,l=s?s.y/r.y:0;e.coordinateSystem===No||e.reversedDepth?t.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,.5,.5,0,0,0,1),t.multiply(xd)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},Oc=new W,Fc=new bn,ts=new W,ol=class extends Sn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Tt,this.projectionMatrix=new Tt,this.projectionMatrixInverse=new Tt,this.coordinateSystem=Ei,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Oc,Fc,ts),ts.x===1&&ts.y===1&&ts.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Oc,Fc,ts.set(1,1,1)).invert()}updateWorldMatrix(e,t,i=!1){super.updateWorldMatrix(e,t,i),this.matrixWorld.decompose(Oc,Fc,ts),ts.x===1&&ts.y===1&&ts.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Oc,Fc,ts.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Zs=new W,I_=new We,C_=new We,Gn=class extends ol{constructor(e=50,t=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Do*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(Ga*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Do*2*Math.atan(Math.tan(Ga*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,i){Zs.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(Zs.x,Zs.y).multiplyScalar(-e/Zs.z),Zs.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(Zs.x,Zs.y).multiplyScalar(-e/Zs.z)}getViewSize(e,t){return this.getViewBounds(e,I_,C_),t.subVectors(C_,I_)}setViewOffset(e,t,i,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(Ga*.5*this.fov)/this.zoom,i=2*t,s=this.aspect*i,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let c=o.fullWidth,l=o.fullHeight;r+=o.offsetX*s/c,t-=o.offsetY*i/l,s*=o.width/c,i*=o.height/l}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-i,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var Ed=class extends rl{constructor(){super(new Gn(90,1,.5,500)),this.isPointLightShadow=!0}},al=class extends Vo{constructor(e,t,i=0,s=2){super(e,t),this.isPointLight=!0,this.type="PointLight",this.distance=i,this.decay=s,this.shadow=new Ed}get power(){return this.intensity*4*Math.PI}set power(e){this.intensity=e/(4*Math.PI)}dispose(){super.dispose(),this.shadow.dispose()}copy(e,t){return super.copy(e,t),this.distance=e.distance,this.decay=e.decay,this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.distance=this.distance,t.object.decay=this.decay,t.object.shadow=this.shadow.toJSON(),t}},ll=class extends ol{constructor(e=-1,t=1,i=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=i,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,i,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-e,o=i+e,a=s+t,c=s-t;if(this.view!==null&&this.view.enabled){let l=(this.right-this.left)/this.view.fullWidth/this.zoom,u=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=l*this.view.offsetX,o=r+l*this.view.width,a-=u*this.view.offsetY,c=a-u*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,c,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},Td=class extends rl{constructor(){super(new ll(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},cl=class extends Vo{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Sn.DEFAULT_UP),this.updateMatrix(),this.target=new Sn,this.shadow=new Td}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var Ro=-90,Io=1,Ho=class extends Sn{constructor(e,t,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new Gn(Ro,Io,e,t);s.layers=this.layers,this.add(s);let r=new Gn(Ro,Io,e,t);r.layers=this.layers,this.add(r);let o=new Gn(Ro,Io,e,t);o.layers=this.layers,this.add(o);let a=new Gn(Ro,Io,e,t);a.layers=this.layers,this.add(a);let c=new Gn(Ro,Io,e,t);c.layers=this.layers,this.add(c);let l=new Gn(Ro,Io,e,t);l.layers=this.layers,this.add(l)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[i,s,r,o,a,c]=t;for(let l of t)this.remove(l);if(e===Ei)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),c.up.set(0,1,0),c.lookAt(0,0,-1);else if(e===No)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),c.up.set(0,-1,0),c.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let l of t)this.add(l),l.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,c,l,u]=this.children,h=e.getRenderTarget(),f=e.getActiveCubeFace(),d=e.getActiveMipmapLevel(),p=e.xr.enabled;e.xr.enabled=!1;let S=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let g=!1;e.isWebGLRenderer===!0?g=e.state.buffers.depth.getReversed():g=e.reversedDepthBuffer,e.setRenderTarget(i,0,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(i,1,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(i,2,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(i,3,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),e.setRenderTarget(i,4,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),i.texture.mipmapsAutoUpdate=S,e.setRenderTarget(i,5,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,u),e.setRenderTarget(h,f,d),e.xr.enabled=p,i.texture.needsPMREMUpdate=!0}},du=class extends Gn{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var ip="\\[\\]\\.:\\/",yE=new RegExp("["+ip+"]","g"),sp="[^"+ip+"]",xE="[^"+ip.replace("\\.","")+"]",vE=/((?:WC+[\/:])*)/.source.replace("WC",sp),bE=/(WCOD+)?/.source.replace("WCOD",xE),SE=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",sp),ME=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",sp),EE=new RegExp("^"+vE+bE+SE+ME+"$"),TE=["material","materials","bones","map"],Ad=class{constructor(e,t,i){let s=i||Yt.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(e,t)}setValue(e,t){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].unbind()}},Yt=class n{constructor(e,t,i){this.path=t,this.parsedPath=i||n.parseTrackName(t),this.node=n.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,i){return e&&e.isAnimationObjectGroup?new n.Composite(e,t,i):new n(e,t,i)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(yE,"")}static parseTrackName(e){let t=EE.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let i={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);TE.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return i}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let i=e.skeleton.getBoneByName(t);if(i!==void 0)return i}if(e.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let c=i(a.children);if(c)return c}return null},s=i(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)e[t++]=i[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,i=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=n.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){qe("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let l=t.objectIndex;switch(i){case"materials":if(!e.material){Qe("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){Qe("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){Qe("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let u=0;u<e.length;u++)if(e[u].name===l){l=u;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){Qe("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){Qe("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[i]===void 0){Qe("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[i]}if(l!==void 0){if(e[l]===void 0){Qe("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[l]}}let o=e[s];if(o===void 0){let l=t.nodeName;Qe("PropertyBinding: Trying to update property for track: "+l+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let c=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){Qe("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){Qe("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}c=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(c=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(c=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[c],this.setValue=this.SetterByBindingTypeAndVersioning[c][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Yt.Composite=Ad;Yt.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Yt.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Yt.prototype.GetterByBindingType=[Yt.prototype._getValue_direct,Yt.prototype._getValue_array,Yt.prototype._getValue_arrayElement,Yt.prototype._getValue_toArray];Yt.prototype.SetterByBindingTypeAndVersioning=[[Yt.prototype._setValue_direct,Yt.prototype._setValue_direct_setNeedsUpdate,Yt.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Yt.prototype._setValue_array,Yt.prototype._setValue_array_setNeedsUpdate,Yt.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Yt.prototype._setValue_arrayElement,Yt.prototype._setValue_arrayElement_setNeedsUpdate,Yt.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Yt.prototype._setValue_fromArray,Yt.prototype._setValue_fromArray_setNeedsUpdate,Yt.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var pN=new Float32Array(1);var Wo=class{constructor(e=1,t=0,i=0){this.radius=e,this.phi=t,this.theta=i}set(e,t,i){return this.radius=e,this.phi=t,this.theta=i,this}copy(e){return this.radius=e.radius,this.phi=e.phi,this.theta=e.theta,this}makeSafe(){return this.phi=mt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(e){return this.setFromCartesianCoords(e.x,e.y,e.z)}setFromCartesianCoords(e,t,i){return this.radius=Math.sqrt(e*e+t*t+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(e,i),this.phi=Math.acos(mt(t/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var wd=class{static{this.prototype.isMatrix2=!0}constructor(e,t,i,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let i=0;i<4;i++)this.elements[i]=e[i+t];return this}set(e,t,i,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=i,r[3]=s,this}};var ul=class extends Gi{constructor(e,t=null){super(),this.object=e,this.domElement=t,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(e){this.domElement!==null&&this.disconnect(),this.domElement=e}disconnect(){}dispose(){}update(){}};function rp(n,e,t,i){let s=AE(i);switch(t){case Xd:return n*e;case bu:return n*e/s.components*s.byteLength;case Su:return n*e/s.components*s.byteLength;case or:return n*e*2/s.components*s.byteLength;case Mu:return n*e*2/s.components*s.byteLength;case Yd:return n*e*3/s.components*s.byteLength;case Hi:return n*e*4/s.components*s.byteLength;case Eu:return n*e*4/s.components*s.byteLength;case dl:case pl:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case ml:case gl:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Au:case Ru:return Math.max(n,16)*Math.max(e,8)/4;case Tu:case wu:return Math.max(n,8)*Math.max(e,8)/2;case Iu:case Cu:case Nu:case Lu:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case Pu:case _l:case Du:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Uu:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Ou:return Math.floor((n+4)/5)*Math.floor((e+3)/4)*16;case Fu:return Math.floor((n+4)/5)*Math.floor((e+4)/5)*16;case Bu:return Math.floor((n+5)/6)*Math.floor((e+4)/5)*16;case ku:return Math.floor((n+5)/6)*Math.floor((e+5)/6)*16;case Gu:return Math.floor((n+7)/8)*Math.floor((e+4)/5)*16;case zu:return Math.floor((n+7)/8)*Math.floor((e+5)/6)*16;case Vu:return Math.floor((n+7)/8)*Math.floor((e+7)/8)*16;case Hu:return Math.floor((n+9)/10)*Math.floor((e+4)/5)*16;case Wu:return Math.floor((n+9)/10)*Math.floor((e+5)/6)*16;case Xu:return Math.floor((n+9)/10)*Math.floor((e+7)/8)*16;case Yu:return Math.floor((n+9)/10)*Math.floor((e+9)/10)*16;case Ku:return Math.floor((n+11)/12)*Math.floor((e+9)/10)*16;case Zu:return Math.floor((n+11)/12)*Math.floor((e+11)/12)*16;case qu:case $u:case Ju:return Math.ceil(n/4)*Math.ceil(e/4)*16;case ju:case Qu:return Math.ceil(n/4)*Math.ceil(e/4)*8;case yl:case eh:return Math.ceil(n/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function AE(n){switch(n){case ti:case zd:return{byteLength:1,components:1};case Zo:case Vd:case Vi:return{byteLength:2,components:1};case xu:case vu:return{byteLength:2,components:4};case zi:case yu:case Ai:return{byteLength:4,components:1};case Hd:case Wd:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?qe("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function ky(){let n=null,e=!1,t=null,i=null;function s(r,o){i=n.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&n!==null&&(i=n.requestAnimationFrame(s),e=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){n=r}}}function PE(n){let e=new WeakMap;function t(a,c){let l=a.array,u=a.usage,h=l.byteLength,f=n.createBuffer();n.bindBuffer(c,f),n.bufferData(c,l,u),a.onUploadCallback();let d;if(l instanceof Float32Array)d=n.FLOAT;else if(typeof Float16Array<"u"&&l instanceof Float16Array)d=n.HALF_FLOAT;else if(l instanceof Uint16Array)a.isFloat16BufferAttribute?d=n.HALF_FLOAT:d=n.UNSIGNED_SHORT;else if(l instanceof Int16Array)d=n.SHORT;else if(l instanceof Uint32Array)d=n.UNSIGNED_INT;else if(l instanceof Int32Array)d=n.INT;else if(l instanceof Int8Array)d=n.BYTE;else if(l instanceof Uint8Array)d=n.UNSIGNED_BYTE;else if(l instanceof Uint8ClampedArray)d=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+l);return{buffer:f,type:d,bytesPerElement:l.BYTES_PER_ELEMENT,version:a.version,size:h}}function i(a,c,l){let u=c.array,h=c.updateRanges;if(n.bindBuffer(l,a),h.length===0)n.bufferSubData(l,0,u);else{h.sort((d,p)=>d.start-p.start);let f=0;for(let d=1;d<h.length;d++){let p=h[f],S=h[d];S.start<=p.start+p.count+1?p.count=Math.max(p.count,S.start+S.count-p.start):(++f,h[f]=S)}h.length=f+1;for(let d=0,p=h.length;d<p;d++){let S=h[d];n.bufferSubData(l,S.start*u.BYTES_PER_ELEMENT,u,S.start,S.count)}c.clearUpdateRanges()}c.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let c=e.get(a);c&&(n.deleteBuffer(c.buffer),e.delete(a))}function o(a,c){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let u=e.get(a);(!u||u.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let l=e.get(a);if(l===void 0)e.set(a,t(a,c));else if(l.version<a.version){if(l.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(l.buffer,a,c),l.version=a.version}}return{get:s,remove:r,update:o}}var NE=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,LE=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,DE=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,UE=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,OE=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,FE=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,BE=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,kE=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,GE=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,zE=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,VE=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,HE=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,WE=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,XE=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,YE=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,KE=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,ZE=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,qE=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,$E=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,JE=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,jE=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,QE=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,eT=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,tT=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,nT=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,iT=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,sT=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,rT=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,oT=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,aT="gl_FragColor = linearToOutputTexel( gl_FragColor );",lT=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,cT=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,uT=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,hT=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,fT=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,dT=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,pT=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,mT=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,gT=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,_T=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,yT=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,xT=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,vT=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,bT=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,ST=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,MT=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,ET=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,TT=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,AT=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,wT=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,RT=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,IT=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,CT=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,PT=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,NT=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,LT=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,DT=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,UT=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,OT=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,FT=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,BT=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,kT=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,GT=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,zT=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,VT=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,HT=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,WT=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,XT=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,YT=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,KT=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,ZT=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,qT=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,$T=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,JT=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,jT=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,QT=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,eA=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,tA=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,nA=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,iA=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,sA=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,rA=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,oA=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,aA=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,lA=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,cA=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,uA=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,hA=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,fA=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,dA=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,pA=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,mA=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,gA=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,_A=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,yA=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,xA=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,vA=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,bA=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,SA=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,MA=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,EA=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,TA=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,AA=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,wA=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,RA=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,IA=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,CA=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,PA=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,NA=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,LA=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,DA=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,UA=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,OA=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,FA=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,BA=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,kA=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,GA=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,zA=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,VA=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,HA=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,WA=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,XA=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,YA=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,KA=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,ZA=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,qA=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,$A=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,JA=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,jA=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,QA=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,e1=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,t1=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,n1=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,i1=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,s1=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,r1=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,o1=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,a1=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,l1=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,c1=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,u1=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,ht={alphahash_fragment:NE,alphahash_pars_fragment:LE,alphamap_fragment:DE,alphamap_pars_fragment:UE,alphatest_fragment:OE,alphatest_pars_fragment:FE,aomap_fragment:BE,aomap_pars_fragment:kE,batching_pars_vertex:GE,batching_vertex:zE,begin_vertex:VE,beginnormal_vertex:HE,bsdfs:WE,iridescence_fragment:XE,bumpmap_pars_fragment:YE,clipping_planes_fragment:KE,clipping_planes_pars_fragment:ZE,clipping_planes_pars_vertex:qE,clipping_planes_vertex:$E,color_fragment:JE,color_pars_fragment:jE,color_pars_vertex:QE,color_vertex:eT,common:tT,defaultnormal_vertex:nT,displacementmap_pars_vertex:iT,displacementmap_vertex:sT,emissivemap_fragment:rT,emissivemap_pars_fragment:oT,colorspace_fragment:aT,colorspace_pars_fragment:lT,envmap_fragment:cT,envmap_common_pars_fragment:uT,envmap_pars_fragment:hT,envmap_pars_vertex:fT,envmap_physical_pars_fragment:MT,envmap_vertex:dT,fog_vertex:pT,fog_pars_vertex:mT,fog_fragment:gT,fog_pars_fragment:_T,gradientmap_pars_fragment:yT,lightmap_pars_fragment:xT,lights_lambert_fragment:vT,lights_lambert_pars_fragment:bT,lights_pars_begin:ST,lights_toon_fragment:ET,lights_toon_pars_fragment:TT,lights_phong_fragment:AT,lights_phong_pars_fragment:wT,lights_physical_fragment:RT,lights_physical_pars_fragment:IT,lights_fragment_begin:CT,lights_fragment_maps:PT,lights_fragment_end:NT,lightprobes_pars_fragment:LT,logdepthbuf_fragment:DT,logdepthbuf_pars_fragment:UT,logdepthbuf_pars_vertex:OT,logdepthbuf_vertex:FT,map_fragment:BT,map_pars_fragment:kT,map_particle_fragment:GT,map_particle_pars_fragment:zT,metalnessmap_fragment:VT,metalnessmap_pars_fragment:HT,morphinstance_vertex:WT,morphcolor_vertex:XT,morphnormal_vertex:YT,morphtarget_pars_vertex:KT,morphtarget_vertex:ZT,normal_fragment_begin:qT,normal_fragment_maps:$T,normal_pars_fragment:JT,normal_pars_vertex:jT,normal_vertex:QT,normalmap_pars_fragment:eA,clearcoat_normal_fragment_begin:tA,clearcoat_normal_fragment_maps:nA,clearcoat_pars_fragment:iA,iridescence_pars_fragment:sA,opaque_fragment:rA,packing:oA,premultiplied_alpha_fragment:aA,project_vertex:lA,dithering_fragment:cA,dithering_pars_fragment:uA,roughnessmap_fragment:hA,roughnessmap_pars_fragment:fA,shadowmap_pars_fragment:dA,shadowmap_pars_vertex:pA,shadowmap_vertex:mA,shadowmask_pars_fragment:gA,skinbase_vertex:_A,skinning_pars_vertex:yA,skinning_vertex:xA,skinnormal_vertex:vA,specularmap_fragment:bA,specularmap_pars_fragment:SA,tonemapping_fragment:MA,tonemapping_pars_fragment:EA,transmission_fragment:TA,transmission_pars_fragment:AA,uv_pars_fragment:wA,uv_pars_vertex:RA,uv_vertex:IA,worldpos_vertex:CA,background_vert:PA,background_frag:NA,backgroundCube_vert:LA,backgroundCube_frag:DA,cube_vert:UA,cube_frag:OA,depth_vert:FA,depth_frag:BA,distance_vert:kA,distance_frag:GA,equirect_vert:zA,equirect_frag:VA,linedashed_vert:HA,linedashed_frag:WA,meshbasic_vert:XA,meshbasic_frag:YA,meshlambert_vert:KA,meshlambert_frag:ZA,meshmatcap_vert:qA,meshmatcap_frag:$A,meshnormal_vert:JA,meshnormal_frag:jA,meshphong_vert:QA,meshphong_frag:e1,meshphysical_vert:t1,meshphysical_frag:n1,meshtoon_vert:i1,meshtoon_frag:s1,points_vert:r1,points_frag:o1,shadow_vert:a1,shadow_frag:l1,sprite_vert:c1,sprite_frag:u1},Ne={common:{diffuse:{value:new rt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new nt},alphaMap:{value:null},alphaMapTransform:{value:new nt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new nt}},envmap:{envMap:{value:null},envMapRotation:{value:new nt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new nt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new nt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new nt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new nt},normalScale:{value:new We(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new nt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new nt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new nt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new nt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new rt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new rt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new nt},alphaTest:{value:0},uvTransform:{value:new nt}},sprite:{diffuse:{value:new rt(16777215)},opacity:{value:1},center:{value:new We(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new nt},alphaMap:{value:null},alphaMapTransform:{value:new nt},alphaTest:{value:0}}},cs={basic:{uniforms:zn([Ne.common,Ne.specularmap,Ne.envmap,Ne.aomap,Ne.lightmap,Ne.fog]),vertexShader:ht.meshbasic_vert,fragmentShader:ht.meshbasic_frag},lambert:{uniforms:zn([Ne.common,Ne.specularmap,Ne.envmap,Ne.aomap,Ne.lightmap,Ne.emissivemap,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.fog,Ne.lights,{emissive:{value:new rt(0)},envMapIntensity:{value:1}}]),vertexShader:ht.meshlambert_vert,fragmentShader:ht.meshlambert_frag},phong:{uniforms:zn([Ne.common,Ne.specularmap,Ne.envmap,Ne.aomap,Ne.lightmap,Ne.emissivemap,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.fog,Ne.lights,{emissive:{value:new rt(0)},specular:{value:new rt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:ht.meshphong_vert,fragmentShader:ht.meshphong_frag},standard:{uniforms:zn([Ne.common,Ne.envmap,Ne.aomap,Ne.lightmap,Ne.emissivemap,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.roughnessmap,Ne.metalnessmap,Ne.fog,Ne.lights,{emissive:{value:new rt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:ht.meshphysical_vert,fragmentShader:ht.meshphysical_frag},toon:{uniforms:zn([Ne.common,Ne.aomap,Ne.lightmap,Ne.emissivemap,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.gradientmap,Ne.fog,Ne.lights,{emissive:{value:new rt(0)}}]),vertexShader:ht.meshtoon_vert,fragmentShader:ht.meshtoon_frag},matcap:{uniforms:zn([Ne.common,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.fog,{matcap:{value:null}}]),vertexShader:ht.meshmatcap_vert,fragmentShader:ht.meshmatcap_frag},points:{uniforms:zn([Ne.points,Ne.fog]),vertexShader:ht.points_vert,fragmentShader:ht.points_frag},dashed:{uniforms:zn([Ne.common,Ne.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:ht.linedashed_vert,fragmentShader:ht.linedashed_frag},depth:{uniforms:zn([Ne.common,Ne.displacementmap]),vertexShader:ht.depth_vert,fragmentShader:ht.depth_frag},normal:{uniforms:zn([Ne.common,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,{opacity:{value:1}}]),vertexShader:ht.meshnormal_vert,fragmentShader:ht.meshnormal_frag},sprite:{uniforms:zn([Ne.sprite,Ne.fog]),vertexShader:ht.sprite_vert,fragmentShader:ht.sprite_frag},background:{uniforms:{uvTransform:{value:new nt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:ht.background_vert,fragmentShader:ht.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new nt}},vertexShader:ht.backgroundCube_vert,fragmentShader:ht.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:ht.cube_vert,fragmentShader:ht.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:ht.equirect_vert,fragmentShader:ht.equirect_frag},distance:{uniforms:zn([Ne.common,Ne.displacementmap,{referencePosition:{value:new W},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:ht.distance_vert,fragmentShader:ht.distance_frag},shadow:{uniforms:zn([Ne.lights,Ne.fog,{color:{value:new rt(0)},opacity:{value:1}}]),vertexShader:ht.shadow_vert,fragmentShader:ht.shadow_frag}};cs.physical={uniforms:zn([cs.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new nt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new nt},clearcoatNormalScale:{value:new We(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new nt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new nt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new nt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new nt},sheen:{value:0},sheenColor:{value:new rt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new nt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new nt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new nt},transmissionSamplerSize:{value:new We},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new nt},attenuationDistance:{value:0},attenuationColor:{value:new rt(0)},specularColor:{value:new rt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new nt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new nt},anisotropyVector:{value:new We},anisotropyMap:{value:null},anisotropyMapTransform:{value:new nt}}]),vertexShader:ht.meshphysical_vert,fragmentShader:ht.meshphysical_frag};var ih={r:0,b:0,g:0},h1=new Tt,Gy=new nt;Gy.set(-1,0,0,0,1,0,0,0,1);function f1(n,e,t,i,s,r){let o=new rt(0),a=s===!0?0:1,c,l,u=null,h=0,f=null;function d(b){let I=b.isScene===!0?b.background:null;if(I&&I.isTexture){let x=b.backgroundBlurriness>0;I=e.get(I,x)}return I}function p(b){let I=!1,x=d(b);x===null?g(o,a):x&&x.isColor&&(g(x,1),I=!0);let w=n.xr.getEnvironmentBlendMode();w==="additive"?t.buffers.color.setClear(0,0,0,1,r):w==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(n.autoClear||I)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function S(b,I){let x=d(I);x&&x.isCubeTexture?(l===void 0&&(l=new Ct(new Qs(1,1,1),new rs({name:"BackgroundCubeMaterial",uniforms:Ur(cs.backgroundCube.uniforms),vertexShader:cs.backgroundCube.vertexShader,fragmentShader:cs.backgroundCube.fragmentShader,side:Mn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),l.geometry.deleteAttribute("uv"),l.onBeforeRender=function(w,A,_){this.matrixWorld.copyPosition(_.matrixWorld)},Object.defineProperty(l.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(l)),l.material.uniforms.envMap.value=x,l.material.uniforms.backgroundBlurriness.value=I.backgroundBlurriness,l.material.uniforms.backgroundIntensity.value=I.backgroundIntensity,l.material.uniforms.backgroundRotation.value.setFromMatrix4(h1.makeRotationFromEuler(I.backgroundRotation)).transpose(),x.isRenderTargetTexture===!1&&l.material.uniforms.backgroundRotation.value.premultiply(Gy),l.material.toneMapped=xt.getTransfer(x.colorSpace)!==It,(u!==x||h!==x.version||f!==n.toneMapping)&&(l.material.needsUpdate=!0,u=x,h=x.version,f=n.toneMapping),l.layers.enableAll(),b.unshift(l,l.geometry,l.material,0,0,null)):x&&x.isTexture&&(c===void 0&&(c=new Ct(new wr(2,2),new rs({name:"BackgroundMaterial",uniforms:Ur(cs.background.uniforms),vertexShader:cs.background.vertexShader,fragmentShader:cs.background.fragmentShader,side:rr,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(c)),c.material.uniforms.t2D.value=x,c.material.uniforms.backgroundIntensity.value=I.backgroundIntensity,c.material.toneMapped=xt.getTransfer(x.colorSpace)!==It,x.matrixAutoUpdate===!0&&x.updateMatrix(),c.material.uniforms.uvTransform.value.copy(x.matrix),(u!==x||h!==x.version||f!==n.toneMapping)&&(c.material.needsUpdate=!0,u=x,h=x.version,f=n.toneMapping),c.layers.enableAll(),b.unshift(c,c.geometry,c.material,0,0,null))}function g(b,I){b.getRGB(ih,np(n)),t.buffers.color.setClear(ih.r,ih.g,ih.b,I,r)}function m(){l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0),c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0)}return{getClearColor:function(){return o},setClearColor:function(b,I=1){o.set(b),a=I,g(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(b){a=b,g(o,a)},render:p,addToRenderList:S,dispose:m}}function d1(n,e){let t=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=f(null),r=s,o=!1;function a(P,B,G,N,V){let Y=!1,z=h(P,N,G,B);r!==z&&(r=z,l(r.object)),Y=d(P,N,G,V),Y&&p(P,N,G,V),V!==null&&e.update(V,n.ELEMENT_ARRAY_BUFFER),(Y||o)&&(o=!1,x(P,B,G,N),V!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,e.get(V).buffer))}function c(){return n.createVertexArray()}function l(P){return n.bindVertexArray(P)}function u(P){return n.deleteVertexArray(P)}function h(P,B,G,N){let V=N.wireframe===!0,Y=i[B.id];Y===void 0&&(Y={},i[B.id]=Y);let z=P.isInstancedMesh===!0?P.id:0,le=Y[z];le===void 0&&(le={},Y[z]=le);let q=le[G.id];q===void 0&&(q={},le[G.id]=q);let j=q[V];return j===void 0&&(j=f(c()),q[V]=j),j}function f(P){let B=[],G=[],N=[];for(let V=0;V<t;V++)B[V]=0,G[V]=0,N[V]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:B,enabledAttributes:G,attributeDivisors:N,object:P,attributes:{},index:null}}function d(P,B,G,N){let V=r.attributes,Y=B.attributes,z=0,le=G.getAttributes();for(let q in le)if(le[q].location>=0){let te=V[q],fe=Y[q];if(fe===void 0&&(q==="instanceMatrix"&&P.instanceMatrix&&(fe=P.instanceMatrix),q==="instanceColor"&&P.instanceColor&&(fe=P.instanceColor)),te===void 0||te.attribute!==fe||fe&&te.data!==fe.data)return!0;z++}return r.attributesNum!==z||r.index!==N}function p(P,B,G,N){let V={},Y=B.attributes,z=0,le=G.getAttributes();for(let q in le)if(le[q].location>=0){let te=Y[q];te===void 0&&(q==="instanceMatrix"&&P.instanceMatrix&&(te=P.instanceMatrix),q==="instanceColor"&&P.instanceColor&&(te=P.instanceColor));let fe={};fe.attribute=te,te&&te.data&&(fe.data=te.data),V[q]=fe,z++}r.attributes=V,r.attributesNum=z,r.index=N}function S(){let P=r.newAttributes;for(let B=0,G=P.length;B<G;B++)P[B]=0}function g(P){m(P,0)}function m(P,B){let G=r.newAttributes,N=r.enabledAttributes,V=r.attributeDivisors;G[P]=1,N[P]===0&&(n.enableVertexAttribArray(P),N[P]=1),V[P]!==B&&(n.vertexAttribDivisor(P,B),V[P]=B)}function b(){let P=r.newAttributes,B=r.enabledAttributes;for(let G=0,N=B.length;G<N;G++)B[G]!==P[G]&&(n.disableVertexAttribArray(G),B[G]=0)}function I(P,B,G,N,V,Y,z){z===!0?n.vertexAttribIPointer(P,B,G,V,Y):n.vertexAttribPointer(P,B,G,N,V,Y)}function x(P,B,G,N){S();let V=N.attributes,Y=G.getAttributes(),z=B.defaultAttributeValues;for(let le in Y){let q=Y[le];if(q.location>=0){let j=V[le];if(j===void 0&&(le==="instanceMatrix"&&P.instanceMatrix&&(j=P.instanceMatrix),le==="instanceColor"&&P.instanceColor&&(j=P.instanceColor)),j!==void 0){let te=j.normalized,fe=j.itemSize,he=e.get(j);if(he===void 0)continue;let ee=he.buffer,me=he.type,ye=he.bytesPerElement,we=me===n.INT||me===n.UNSIGNED_INT||j.gpuType===yu;if(j.isInterleavedBufferAttribute){let Se=j.data,Xe=Se.isInterleavedBuffer===!0?Se.stride:Se.itemSize,ot=j.offset;if(Se.isInstancedInterleavedBuffer||Se.isInstancedBufferAttribute){for(let Ve=0;Ve<q.locationSize;Ve++)m(q.location+Ve,Se.meshPerAttribute);P.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=Se.meshPerAttribute*Se.count)}else for(let Ve=0;Ve<q.locationSize;Ve++)g(q.location+Ve);n.bindBuffer(n.ARRAY_BUFFER,ee);for(let Ve=0;Ve<q.locationSize;Ve++)I(q.location+Ve,fe/q.locationSize,me,te,Xe*ye,(ot+fe/q.locationSize*Ve)*ye,we)}else{if(j.isInstancedBufferAttribute){for(let Se=0;Se<q.locationSize;Se++)m(q.location+Se,j.meshPerAttribute);P.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=j.meshPerAttribute*j.count)}else for(let Se=0;Se<q.locationSize;Se++)g(q.location+Se);n.bindBuffer(n.ARRAY_BUFFER,ee);for(let Se=0;Se<q.locationSize;Se++)I(q.location+Se,fe/q.locationSize,me,te,fe*ye,fe/q.locationSize*Se*ye,we)}}else if(z!==void 0){let te=z[le];if(te!==void 0)switch(te.length){case 2:n.vertexAttrib2fv(q.location,te);break;case 3:n.vertexAttrib3fv(q.location,te);break;case 4:n.vertexAttrib4fv(q.location,te);break;default:n.vertexAttrib1fv(q.location,te)}}}}b()}function w(){F();for(let P in i){let B=i[P];for(let G in B){let N=B[G];for(let V in N){let Y=N[V];for(let z in Y)u(Y[z].object),delete Y[z];delete N[V]}}delete i[P]}}function A(P){if(i[P.id]===void 0)return;let B=i[P.id];for(let G in B){let N=B[G];for(let V in N){let Y=N[V];for(let z in Y)u(Y[z].object),delete Y[z];delete N[V]}}delete i[P.id]}function _(P){for(let B in i){let G=i[B];for(let N in G){let V=G[N];if(V[P.id]===void 0)continue;let Y=V[P.id];for(let z in Y)u(Y[z].object),delete Y[z];delete V[P.id]}}}function T(P){for(let B in i){let G=i[B],N=P.isInstancedMesh===!0?P.id:0,V=G[N];if(V!==void 0){for(let Y in V){let z=V[Y];for(let le in z)u(z[le].object),delete z[le];delete V[Y]}delete G[N],Object.keys(G).length===0&&delete i[B]}}}function F(){D(),o=!0,r!==s&&(r=s,l(r.object))}function D(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:F,resetDefaultState:D,dispose:w,releaseStatesOfGeometry:A,releaseStatesOfObject:T,releaseStatesOfProgram:_,initAttributes:S,enableAttribute:g,disableUnusedAttributes:b}}function p1(n,e,t){let i;function s(c){i=c}function r(c,l){n.drawArrays(i,c,l),t.update(l,i,1)}function o(c,l,u){u!==0&&(n.drawArraysInstanced(i,c,l,u),t.update(l,i,u))}function a(c,l,u){if(u===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,c,0,l,0,u);let f=0;for(let d=0;d<u;d++)f+=l[d];t.update(f,i,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function m1(n,e,t,i){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let _=e.get("EXT_texture_filter_anisotropic");s=n.getParameter(_.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(_){return!(_!==Hi&&i.convert(_)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(_){let T=_===Vi&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(_!==ti&&_!==Ai&&!T&&i.convert(_)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function c(_){if(_==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";_="mediump"}return _==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let l=t.precision!==void 0?t.precision:"highp",u=c(l);u!==l&&(qe("WebGLRenderer:",l,"not supported, using",u,"instead."),l=u);let h=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),f=t.logarithmicDepthBuffer===!0&&h===!1;t.reversedDepthBuffer===!0&&h===!1&&qe("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&h===!0&&qe("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),p=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),S=n.getParameter(n.MAX_TEXTURE_SIZE),g=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),m=n.getParameter(n.MAX_VERTEX_ATTRIBS),b=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),I=n.getParameter(n.MAX_VARYING_VECTORS),x=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),w=n.getParameter(n.MAX_SAMPLES),A=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:c,textureFormatReadable:o,textureTypeReadable:a,precision:l,logarithmicDepthBuffer:f,reversedDepthBuffer:h,maxTextures:d,maxVertexTextures:p,maxTextureSize:S,maxCubemapSize:g,maxAttributes:m,maxVertexUniforms:b,maxVaryings:I,maxFragmentUniforms:x,maxSamples:w,samples:A}}function g1(n){let e=this,t=null,i=0,s=!1,r=!1,o=new $n,a=new nt,c={value:null,needsUpdate:!1};this.uniform=c,this.numPlanes=0,this.numIntersection=0,this.init=function(h,f){let d=h.length!==0||f||i!==0||s;return s=f,i=h.length,d},this.beginShadows=function(){r=!0,u(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(h,f){t=u(h,f,0)},this.setState=function(h,f,d){let p=h.clippingPlanes,S=h.clipIntersection,g=h.clipShadows,m=n.get(h);if(!s||p===null||p.length===0||r&&!g)r?u(null):l();else{let b=r?0:i,I=b*4,x=m.clippingState||null;c.value=x,x=u(p,f,I,d);for(let w=0;w!==I;++w)x[w]=t[w];m.clippingState=x,this.numIntersection=S?this.numPlanes:0,this.numPlanes+=b}};function l(){c.value!==t&&(c.value=t,c.needsUpdate=i>0),e.numPlanes=i,e.numIntersection=0}function u(h,f,d,p){let S=h!==null?h.length:0,g=null;if(S!==0){if(g=c.value,p!==!0||g===null){let m=d+S*4,b=f.matrixWorldInverse;a.getNormalMatrix(b),(g===null||g.length<m)&&(g=new Float32Array(m));for(let I=0,x=d;I!==S;++I,x+=4)o.copy(h[I]).applyMatrix4(b,a),o.normal.toArray(g,x),g[x+3]=o.constant}c.value=g,c.needsUpdate=!0}return e.numPlanes=S,e.numIntersection=0,g}}var Sl=class extends di{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let i={width:e,height:e,depth:1},s=[i,i,i,i,i,i];this.texture=new ja(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Qs(5,5,5),r=new rs({name:"CubemapFromEquirect",uniforms:Ur(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:Mn,blending:Pr});r.uniforms.tEquirect.value=t;let o=new Ct(s,r),a=t.minFilter;return t.minFilter===Is&&(t.minFilter=Jn),new Ho(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,i=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,i,s);e.setRenderTarget(r)}},yy=256,_1=3,y1=20,zy=256,Vy=16,x1=3,v1=new W,b1=new rt,$o=class n{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Ho(1,10,null),this._boxMesh=new Ct(new Qs(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,i=.1,s=100,r={}){let{size:o=256,position:a=v1}=r,c=this._renderer;this._setSize(o);let l=this._allocateTarget(),u=this._getSourceTarget(!0);t>0&&(u.texture.mipmapsAutoUpdate=!1);let h=c.autoClear,f=c.autoClearColor,d=c.autoClearDepth,p=c.autoClearStencil,S=e.background;c.autoClear=!0,c.autoClearColor=!0,c.autoClearDepth=!0,c.autoClearStencil=!0,S===null&&(e.background=c.getClearColor(b1));let g=new Ho(i,s,u);return g.position.copy(a),g.update(c,e),c.autoClear=h,c.autoClearColor=f,c.autoClearDepth=d,c.autoClearStencil=p,e.background=S,t>0&&(u.texture.mipmapsAutoUpdate=!0,this._blur(l,t)),this._applyPMREM(l),l}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=by(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=vy(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(yy,Qd(e))}_fromTexture(e,t){e.mapping===Lr||e.mapping===Ko?this._setSize(e.image.length===0?yy:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let i=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(i),i}_allocateTarget(){let e=this._cubeSize,t=xy(e,!1,!1),i=Math.log2(e)-_1;for(let s=0;s<=i;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==t||e&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=xy(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===Lr||e.mapping===Ko?(this._cubemapMaterial===null&&(this._cubemapMaterial=by()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=vy()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=S1(),this._integrationMaterial=M1());let t=this._cubeSize,i=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Vy);for(let o=0;o<=i;o++){let a=n.lodToRoughness(o,i);if(o>i-x1)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let c=a>0?Math.log2(t)+.5*Math.log2(6/(zy*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=c,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=E1());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,i),s.envMap.value=e.texture,this._renderCube(r,0,i)}};function xy(n,e,t){return new Sl(n,{minFilter:Is,generateMipmaps:e,type:Vi,colorSpace:Ha,depthBuffer:t})}function Ml(n,e,t){return new rs({name:n,uniforms:e,vertexShader:ht.cube_vert,fragmentShader:t,side:Mn,blending:Pr,depthTest:!1,depthWrite:!1})}function S1(){return Ml("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${zy}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function M1(){return Ml("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Vy}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function E1(){return Ml("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${y1}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function vy(){return Ml("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function by(){return Ml("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function T1(n){let e=new WeakMap,t=new WeakMap,i=null;function s(f,d=!1){return f==null?null:d?o(f):r(f)}function r(f){if(f&&f.isTexture){let d=f.mapping;if(d===mu||d===gu)if(e.has(f)){let p=e.get(f).texture;return a(p,f.mapping)}else{let p=f.image;if(p&&p.height>0){let S=new Sl(p.height);return S.fromEquirectangularTexture(n,f),e.set(f,S),f.addEventListener("dispose",l),a(S.texture,f.mapping)}else return null}}return f}function o(f){if(f&&f.isTexture&&f.isPMREMTexture!==!0){let d=f.mapping,p=d===mu||d===gu,S=d===Lr||d===Ko;if(p||S){let g=t.get(f),m=g!==void 0?g.texture.pmremVersion:0;if(f.isRenderTargetTexture&&f.pmremVersion!==m)return i===null&&(i=new $o(n)),g=p?i.fromEquirectangular(f,g):i.fromCubemap(f,g),g.texture.pmremVersion=f.pmremVersion,t.set(f,g),g.texture;if(g!==void 0)return g.texture;{let b=f.image;return p&&b&&b.height>0||S&&b&&c(b)?(i===null&&(i=new $o(n)),g=p?i.fromEquirectangular(f):i.fromCubemap(f),g.texture.pmremVersion=f.pmremVersion,t.set(f,g),f.addEventListener("dispose",u),g.texture):null}}}return f}function a(f,d){return d===mu?f.mapping=Lr:d===gu&&(f.mapping=Ko),f}function c(f){let d=0,p=6;for(let S=0;S<p;S++)f[S]!==void 0&&d++;return d===p}function l(f){let d=f.target;d.removeEventListener("dispose",l);let p=e.get(d);p!==void 0&&(e.delete(d),p.dispose())}function u(f){let d=f.target;d.removeEventListener("dispose",u);let p=t.get(d);p!==void 0&&(t.delete(d),p.dispose())}function h(){e=new WeakMap,t=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:h}}function A1(n){let e={};function t(i){if(e[i]!==void 0)return e[i];let s=n.getExtension(i);return e[i]=s,s}return{has:function(i){return t(i)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(i){let s=t(i);return s===null&&ka("WebGLRenderer: "+i+" extension not supported."),s}}}function w1(n,e,t,i){let s={},r=new WeakMap,o=new FinalizationRegistry(p=>delete s[p]);function a(p){c(p.target)}function c(p){p.index!==null&&e.remove(p.index);for(let g in p.attributes)e.remove(p.attributes[g]);p.removeEventListener("dispose",a),delete s[p.id],o.unregister(p);let S=r.get(p);S&&(e.remove(S),r.delete(p)),i.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,t.memory.geometries--}function l(p,S){return s[S.id]!==void 0||(S.addEventListener("dispose",a),s[S.id]=new WeakRef(S),o.register(S,S.id,S),t.memory.geometries++),S}function u(p){let S=p.attributes;for(let g in S)e.update(S[g],n.ARRAY_BUFFER)}function h(p){let S=p.index,g=p.attributes.position,m=0;if(g===void 0)return;let b=S!==null?S.array.length:g.array.length/3-1,I=g.count>=65535?$a:qa,x=new I(Math.ceil(b/3)*6,1),w=x.array;if(S!==null){let _=S.array;m=S.version;for(let T=0,F=0;T<b;T+=3){let D=_[T+0],P=_[T+1],B=_[T+2];w[F++]=D,w[F++]=P,w[F++]=P,w[F++]=B,w[F++]=B,w[F++]=D}}else{m=g.version;for(let _=0,T=0;_<b;_+=3){let F=_+0,D=_+1,P=_+2;w[T++]=F,w[T++]=D,w[T++]=D,w[T++]=P,w[T++]=P,w[T++]=F}}x.version=m;let A=r.get(p);A&&e.remove(A),r.set(p,x)}function f(p){let S=r.get(p);if(S){let g=p.index;g!==null&&S.version<g.version&&h(p)}else h(p);return r.get(p)}function d(){for(let p in s){let S=s[p].deref();S!==void 0&&c(S)}}return{get:l,update:u,getWireframeAttribute:f,dispose:d}}function R1(n,e,t){let i;function s(h){i=h}let r,o;function a(h){r=h.type,o=h.bytesPerElement}function c(h,f){n.drawElements(i,f,r,h*o),t.update(f,i,1)}function l(h,f,d){d!==0&&(n.drawElementsInstanced(i,f,r,h*o,d),t.update(f,i,d))}function u(h,f,d){if(d===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,f,0,r,h,0,d);let S=0;for(let g=0;g<d;g++)S+=f[g];t.update(S,i,1)}this.setMode=s,this.setIndex=a,this.render=c,this.renderInstances=l,this.renderMultiDraw=u}function I1(n){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(t.calls++,o){case n.TRIANGLES:t.triangles+=a*(r/3);break;case n.LINES:t.lines+=a*(r/2);break;case n.LINE_STRIP:t.lines+=a*(r-1);break;case n.LINE_LOOP:t.lines+=a*r;break;case n.POINTS:t.points+=a*r;break;default:Qe("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:i}}function C1(n,e,t){let i=new WeakMap,s=new qt;function r(o,a,c){let l=o.morphTargetInfluences,u=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,h=u!==void 0?u.length:0,f=i.get(a);if(f===void 0||f.count!==h){let F=function(){_.dispose(),i.delete(a),a.removeEventListener("dispose",F)};f!==void 0&&f.texture.dispose();let d=a.morphAttributes.position!==void 0,p=a.morphAttributes.normal!==void 0,S=a.morphAttributes.color!==void 0,g=a.morphAttributes.position||[],m=a.morphAttributes.normal||[],b=a.morphAttributes.color||[],I=0;d===!0&&(I=1),p===!0&&(I=2),S===!0&&(I=3);let x=a.attributes.position.count*I,w=1;x>e.maxTextureSize&&(w=Math.ceil(x/e.maxTextureSize),x=e.maxTextureSize);let A=new Float32Array(x*w*4*h),_=new Ka(A,x,w,h);_.type=Ai,_.needsUpdate=!0;let T=I*4;for(let D=0;D<h;D++){let P=g[D],B=m[D],G=b[D],N=x*w*4*D;for(let V=0;V<P.count;V++){let Y=V*T;d===!0&&(s.fromBufferAttribute(P,V),A[N+Y+0]=s.x,A[N+Y+1]=s.y,A[N+Y+2]=s.z,A[N+Y+3]=0),p===!0&&(s.fromBufferAttribute(B,V),A[N+Y+4]=s.x,A[N+Y+5]=s.y,A[N+Y+6]=s.z,A[N+Y+7]=0),S===!0&&(s.fromBufferAttribute(G,V),A[N+Y+8]=s.x,A[N+Y+9]=s.y,A[N+Y+10]=s.z,A[N+Y+11]=G.itemSize===4?s.w:1)}}f={count:h,texture:_,size:new We(x,w)},i.set(a,f),a.addEventListener("dispose",F)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)c.getUniforms().setValue(n,"morphTexture",o.morphTexture,t);else{let d=0;for(let S=0;S<l.length;S++)d+=l[S];let p=a.morphTargetsRelative?1:1-d;c.getUniforms().setValue(n,"morphTargetBaseInfluence",p),c.getUniforms().setValue(n,"morphTargetInfluences",l)}c.getUniforms().setValue(n,"morphTargetsTexture",f.texture,t),c.getUniforms().setValue(n,"morphTargetsTextureSize",f.size)}return{update:r}}function P1(n,e,t,i,s){let r=new WeakMap;function o(l){let u=s.render.frame,h=l.geometry,f=e.get(l,h);if(r.get(f)!==u&&(e.update(f),r.set(f,u)),l.isInstancedMesh&&(l.hasEventListener("dispose",c)===!1&&l.addEventListener("dispose",c),r.get(l)!==u&&(t.update(l.instanceMatrix,n.ARRAY_BUFFER),l.instanceColor!==null&&t.update(l.instanceColor,n.ARRAY_BUFFER),r.set(l,u))),l.isSkinnedMesh){let d=l.skeleton;r.get(d)!==u&&(d.update(),r.set(d,u))}return f}function a(){r=new WeakMap}function c(l){let u=l.target;u.removeEventListener("dispose",c),i.releaseStatesOfObject(u),t.remove(u.instanceMatrix),u.instanceColor!==null&&t.remove(u.instanceColor)}return{update:o,dispose:a}}var N1={[Dd]:"LINEAR_TONE_MAPPING",[Ud]:"REINHARD_TONE_MAPPING",[Od]:"CINEON_TONE_MAPPING",[Fd]:"ACES_FILMIC_TONE_MAPPING",[kd]:"AGX_TONE_MAPPING",[hl]:"NEUTRAL_TONE_MAPPING",[Bd]:"CUSTOM_TONE_MAPPING"};function L1(n,e,t,i,s,r){let o=new di(e,t,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,c=null,l=null,u=new Qn;u.setAttribute("position",new vn([-1,3,0,-1,-1,0,3,-1,0],3)),u.setAttribute("uv",new vn([0,2,0,0,2,0],2));let h=new eu({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),f=new Ct(u,h),d=new ll(-1,1,1,-1,0,1),p=null,S=null,g=!1,m,b=null,I=[],x=!1;this.setSize=function(w,A){o.setSize(w,A),a!==null&&a.setSize(w,A),c!==null&&c.setSize(w,A);for(let _=0;_<I.length;_++){let T=I[_];T.setSize&&T.setSize(w,A)}},this.setEffects=function(w){I=w,x=I.length>0&&I[0].isRenderPass===!0;let A=o.width,_=o.height;I.length>0&&a===null&&(a=new di(A,_,{type:Vi,depthBuffer:!1,stencilBuffer:!1}),c=new di(A,_,{type:Vi,depthBuffer:!1,stencilBuffer:!1}));let T=s===!0&&I.some(F=>F.needsDepthTexture===!0);T!==(o.depthTexture!==null)&&(T===!0&&l===null&&(l=new Rs(A,_),r===!0&&(l.format=Cs,l.type=Dr)),o.dispose(),o.depthTexture=T?l:null,o.resolveDepthBuffer=T,o.storeMultisampledDepthBuffer=T);for(let F=0;F<I.length;F++){let D=I[F];D.setSize&&D.setSize(A,_),T&&D.needsDepthTexture===!0&&D.setDepthTexture&&D.setDepthTexture(l)}},this.begin=function(w,A){if(g||w.toneMapping===as&&I.length===0)return!1;if(b=A,A!==null){let _=A.width,T=A.height;(o.width!==_||o.height!==T)&&this.setSize(_,T)}return x===!1&&w.setRenderTarget(o),m=w.toneMapping,w.toneMapping=as,!0},this.hasRenderPass=function(){return x},this.end=function(w,A){w.toneMapping=m,g=!0;let _=o,T=a;for(let F=0;F<I.length;F++){let D=I[F];D.enabled!==!1&&(D.render(w,T,_,A),D.needsSwap!==!1&&(_=T,T=T===a?c:a))}if(p!==w.outputColorSpace||S!==w.toneMapping){p=w.outputColorSpace,S=w.toneMapping,h.defines={},xt.getTransfer(p)===It&&(h.defines.SRGB_TRANSFER="");let F=N1[S];F&&(h.defines[F]=""),h.needsUpdate=!0}h.uniforms.tDiffuse.value=_.texture,w.setRenderTarget(b),w.render(f,d),b=null,g=!1},this.isCompositing=function(){return g},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),c!==null&&c.dispose(),u.dispose(),h.dispose()}}var Hy=new jn,Wy=new Rs(1,1),Xy=new el(1),Yy=new Ka,Ky=new jc,Zy=new ja,Sy=[],My=[],Ey=new Float32Array(16),Ty=new Float32Array(9),Ay=new Float32Array(4);function Jo(n,e,t){let i=n[0];if(i<=0||i>0)return n;let s=e*t,r=Sy[s];if(r===void 0&&(r=new Float32Array(s),Sy[s]=r),e!==0){i.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,n[o].toArray(r,a)}return r}function En(n,e){if(n.length!==e.length)return!1;for(let t=0,i=n.length;t<i;t++)if(n[t]!==e[t])return!1;return!0}function Tn(n,e){for(let t=0,i=e.length;t<i;t++)n[t]=e[t]}function oh(n,e){let t=My[e];t===void 0&&(t=new Int32Array(e),My[e]=t);for(let i=0;i!==e;++i)t[i]=n.allocateTextureUnit();return t}function D1(n,e){let t=this.cache;t[0]!==e&&(n.uniform1f(this.addr,e),t[0]=e)}function U1(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(En(t,e))return;n.uniform2fv(this.addr,e),Tn(t,e)}}function O1(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(n.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(En(t,e))return;n.uniform3fv(this.addr,e),Tn(t,e)}}function F1(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(En(t,e))return;n.uniform4fv(this.addr,e),Tn(t,e)}}function B1(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(En(t,e))return;n.uniformMatrix2fv(this.addr,!1,e),Tn(t,e)}else{if(En(t,i))return;Ay.set(i),n.uniformMatrix2fv(this.addr,!1,Ay),Tn(t,i)}}function k1(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(En(t,e))return;n.uniformMatrix3fv(this.addr,!1,e),Tn(t,e)}else{if(En(t,i))return;Ty.set(i),n.uniformMatrix3fv(this.addr,!1,Ty),Tn(t,i)}}function G1(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(En(t,e))return;n.uniformMatrix4fv(this.addr,!1,e),Tn(t,e)}else{if(En(t,i))return;Ey.set(i),n.uniformMatrix4fv(this.addr,!1,Ey),Tn(t,i)}}function z1(n,e){let t=this.cache;t[0]!==e&&(n.uniform1i(this.addr,e),t[0]=e)}function V1(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(En(t,e))return;n.uniform2iv(this.addr,e),Tn(t,e)}}function H1(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(En(t,e))return;n.uniform3iv(this.addr,e),Tn(t,e)}}function W1(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(En(t,e))return;n.uniform4iv(this.addr,e),Tn(t,e)}}function X1(n,e){let t=this.cache;t[0]!==e&&(n.uniform1ui(this.addr,e),t[0]=e)}function Y1(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(En(t,e))return;n.uniform2uiv(this.addr,e),Tn(t,e)}}function K1(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(En(t,e))return;n.uniform3uiv(this.addr,e),Tn(t,e)}}function Z1(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(En(t,e))return;n.uniform4uiv(this.addr,e),Tn(t,e)}}function ah(n){return n.version===0&&(n.compareFunction=qd,n.needsUpdate=!0),n}function q1(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=ah(Wy):r=Hy,t.setTexture2D(e||r,s)}function $1(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture3D(e||Ky,s)}function J1(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=ah(Xy):r=Zy,t.setTextureCube(e||r,s)}function j1(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture2DArray(e||Yy,s)}function Q1(n){switch(n){case 5126:return D1;case 35664:return U1;case 35665:return O1;case 35666:return F1;case 35674:return B1;case 35675:return k1;case 35676:return G1;case 5124:case 35670:return z1;case 35667:case 35671:return V1;case 35668:case 35672:return H1;case 35669:case 35673:return W1;case 5125:return X1;case 36294:return Y1;case 36295:return K1;case 36296:return Z1;case 35678:case 36198:case 36298:case 36306:case 35682:return q1;case 35679:case 36299:case 36307:return $1;case 35680:case 36300:case 36308:case 36293:return J1;case 36289:case 36303:case 36311:case 36292:return j1}}function ew(n,e){n.uniform1fv(this.addr,e)}function tw(n,e){let t=Jo(e,this.size,2);n.uniform2fv(this.addr,t)}function nw(n,e){let t=Jo(e,this.size,3);n.uniform3fv(this.addr,t)}function iw(n,e){let t=Jo(e,this.size,4);n.uniform4fv(this.addr,t)}function sw(n,e){let t=Jo(e,this.size,4);n.uniformMatrix2fv(this.addr,!1,t)}function rw(n,e){let t=Jo(e,this.size,9);n.uniformMatrix3fv(this.addr,!1,t)}function ow(n,e){let t=Jo(e,this.size,16);n.uniformMatrix4fv(this.addr,!1,t)}function aw(n,e){n.uniform1iv(this.addr,e)}function lw(n,e){n.uniform2iv(this.addr,e)}function cw(n,e){n.uniform3iv(this.addr,e)}function uw(n,e){n.uniform4iv(this.addr,e)}function hw(n,e){n.uniform1uiv(this.addr,e)}function fw(n,e){n.uniform2uiv(this.addr,e)}function dw(n,e){n.uniform3uiv(this.addr,e)}function pw(n,e){n.uniform4uiv(this.addr,e)}function mw(n,e,t){let i=this.cache,s=e.length,r=oh(t,s);En(i,r)||(n.uniform1iv(this.addr,r),Tn(i,r));let o;this.type===n.SAMPLER_2D_SHADOW?o=ah(Wy):o=Hy;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function gw(n,e,t){let i=this.cache,s=e.length,r=oh(t,s);En(i,r)||(n.uniform1iv(this.addr,r),Tn(i,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||Ky,r[o])}function _w(n,e,t){let i=this.cache,s=e.length,r=oh(t,s);En(i,r)||(n.uniform1iv(this.addr,r),Tn(i,r));let o;this.type===n.SAMPLER_CUBE_SHADOW?o=ah(Xy):o=Zy;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function yw(n,e,t){let i=this.cache,s=e.length,r=oh(t,s);En(i,r)||(n.uniform1iv(this.addr,r),Tn(i,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||Yy,r[o])}function xw(n){switch(n){case 5126:return ew;case 35664:return tw;case 35665:return nw;case 35666:return iw;case 35674:return sw;case 35675:return rw;case 35676:return ow;case 5124:case 35670:return aw;case 35667:case 35671:return lw;case 35668:case 35672:return cw;case 35669:case 35673:return uw;case 5125:return hw;case 36294:return fw;case 36295:return dw;case 36296:return pw;case 35678:case 36198:case 36298:case 36306:case 35682:return mw;case 35679:case 36299:case 36307:return gw;case 35680:case 36300:case 36308:case 36293:return _w;case 36289:case 36303:case 36311:case 36292:return yw}}var lp=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.setValue=Q1(t.type)}},cp=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=xw(t.type)}},up=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,i){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],i)}}},op=/(\w+)(\])?(\[|\.)?/g;function wy(n,e){n.seq.push(e),n.map[e.id]=e}function vw(n,e,t){let i=n.name,s=i.length;for(op.lastIndex=0;;){let r=op.exec(i),o=op.lastIndex,a=r[1],c=r[2]==="]",l=r[3];if(c&&(a=a|0),l===void 0||l==="["&&o+2===s){wy(t,l===void 0?new lp(a,n,e):new cp(a,n,e));break}else{let h=t.map[a];h===void 0&&(h=new up(a),wy(t,h)),t=h}}}var qo=class{constructor(e,t){this.seq=[],this.map={};let i=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=e.getActiveUniform(t,o),c=e.getUniformLocation(t,a.name);vw(a,c,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,i,s){let r=this.map[t];r!==void 0&&r.setValue(e,i,s)}setOptional(e,t,i){let s=t[i];s!==void 0&&this.setValue(e,i,s)}static upload(e,t,i,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],c=i[a.id];c.needsUpdate!==!1&&a.setValue(e,c.value,s)}}static seqWithValue(e,t){let i=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&i.push(o)}return i}};function Ry(n,e,t){let i=n.createShader(e);return n.shaderSource(i,t),n.compileShader(i),i}var bw=37297,Sw=0;function Mw(n,e){let t=n.split(`
`),i=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;i.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return i.join(`
`)}var Iy=new nt;function Ew(n){xt._getMatrix(Iy,xt.workingColorSpace,n);let e=`mat3( ${Iy.elements.map(t=>t.toFixed(4))} )`;switch(xt.getTransfer(n)){case Wa:return[e,"LinearTransferOETF"];case It:return[e,"sRGBTransferOETF"];default:return qe("WebGLProgram: Unsupported color space: ",n),[e,"LinearTransferOETF"]}}function Cy(n,e,t){let i=n.getShaderParameter(e,n.COMPILE_STATUS),r=(n.getShaderInfoLog(e)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+Mw(n.getShaderSource(e),a)}else return r}function Tw(n,e){let t=Ew(e);return[`vec4 ${n}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var Aw={[Dd]:"Linear",[Ud]:"Reinhard",[Od]:"Cineon",[Fd]:"ACESFilmic",[kd]:"AgX",[hl]:"Neutral",[Bd]:"Custom"};function ww(n,e){let t=Aw[e];return t===void 0?(qe("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var sh=new W;function Rw(){xt.getLuminanceCoefficients(sh);let n=sh.x.toFixed(4),e=sh.y.toFixed(4),t=sh.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function Iw(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(bl).join(`
`)}function Cw(n){let e=[];for(let t in n){let i=n[t];i!==!1&&e.push("#define "+t+" "+i)}return e.join(`
`)}function Pw(n,e){let t={},i=n.getProgramParameter(e,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(e,s),o=r.name,a=1;r.type===n.FLOAT_MAT2&&(a=2),r.type===n.FLOAT_MAT3&&(a=3),r.type===n.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:n.getAttribLocation(e,o),locationSize:a}}return t}function bl(n){return n!==""}function Py(n,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function Ny(n,e){return n.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var Nw=/^[ \t]*#include +<([\w\d./]+)>/gm;function hp(n){return n.replace(Nw,Lw)}function Lw(n,e){let t=ht[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return hp(t)}var Dw=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function Ly(n){return n.replace(Dw,Uw)}function Uw(n,e,t,i){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function Dy(n){let e=`precision ${n.precision} float;
	precision ${n.precision} int;
	precision ${n.precision} sampler2D;
	precision ${n.precision} samplerCube;
	precision ${n.precision} sampler3D;
	precision ${n.precision} sampler2DArray;
	precision ${n.precision} sampler2DShadow;
	precision ${n.precision} samplerCubeShadow;
	precision ${n.precision} sampler2DArrayShadow;
	precision ${n.precision} isampler2D;
	precision ${n.precision} isampler3D;
	precision ${n.precision} isamplerCube;
	precision ${n.precision} isampler2DArray;
	precision ${n.precision} usampler2D;
	precision ${n.precision} usampler3D;
	precision ${n.precision} usamplerCube;
	precision ${n.precision} usampler2DArray;
	`;return n.precision==="highp"?e+=`
#define HIGH_PRECISION`:n.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:n.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var Ow={[Cr]:"SHADOWMAP_TYPE_PCF",[Xo]:"SHADOWMAP_TYPE_VSM"};function Fw(n){return Ow[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var Bw={[Ko]:"ENVMAP_MODE_REFRACTION"};function kw(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":Bw[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var Gw={[pu]:"ENVMAP_BLENDING_MULTIPLY",[j_]:"ENVMAP_BLENDING_MIX",[Q_]:"ENVMAP_BLENDING_ADD"};function zw(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":Gw[n.combine]||"ENVMAP_BLENDING_NONE"}function Vw(n,e,t,i){let s=n.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,c=Fw(t),l=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",u=kw(t),h=zw(t),f=Iw(t),d=Cw(r),p=s.createProgram(),S,g,m=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(S=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d].filter(bl).join(`
`),S.length>0&&(S+=`
`),g=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d].filter(bl).join(`
`),g.length>0&&(g+=`
`)):(S=[Dy(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+u:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+c:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(bl).join(`
`),g=[Dy(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+l:"",t.envMap?"#define "+u:"",t.envMap?"#define "+h:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+c:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==as?"#define TONE_MAPPING":"",t.toneMapping!==as?ht.tonemapping_pars_fragment:"",t.toneMapping!==as?ww("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",ht.colorspace_pars_fragment,Tw("linearToOutputTexel",t.outputColorSpace),Rw(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(bl).join(`
`)),o=hp(o),o=Py(o,t),o=Ny(o,t),a=hp(a),a=Py(a,t),a=Ny(a,t),o=Ly(o),a=Ly(a),t.isRawShaderMaterial!==!0&&(m=`#version 300 es
`,S=[f,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+S,g=["#define varying in",t.glslVersion===Jd?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Jd?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+g);let b=m+S+o,I=m+g+a,x=Ry(s,s.VERTEX_SHADER,b),w=Ry(s,s.FRAGMENT_SHADER,I);s.attachShader(p,x),s.attachShader(p,w),t.index0AttributeName!==void 0?s.bindAttribLocation(p,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(p,0,"position"),s.linkProgram(p);function A(D){if(n.debug.checkShaderErrors){let P=s.getProgramInfoLog(p)||"",B=s.getShaderInfoLog(x)||"",G=s.getShaderInfoLog(w)||"",N=P.trim(),V=B.trim(),Y=G.trim(),z=!0,le=!0;if(s.getProgramParameter(p,s.LINK_STATUS)===!1)if(z=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,p,x,w);else{let q=Cy(s,x,"vertex"),j=Cy(s,w,"fragment");Qe("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(p,s.VALIDATE_STATUS)+`

Material Name: `+D.name+`
Material Type: `+D.type+`

Program Info Log: `+N+`
`+q+`
`+j)}else N!==""?qe("WebGLProgram: Program Info Log:",N):(V===""||Y==="")&&(le=!1);le&&(D.diagnostics={runnable:z,programLog:N,vertexShader:{log:V,prefix:S},fragmentShader:{log:Y,prefix:g}})}s.deleteShader(x),s.deleteShader(w),_=new qo(s,p),T=Pw(s,p)}let _;this.getUniforms=function(){return _===void 0&&A(this),_};let T;this.getAttributes=function(){return T===void 0&&A(this),T};let F=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return F===!1&&(F=s.getProgramParameter(p,bw)),F},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(p),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=Sw++,this.cacheKey=e,this.usedTimes=1,this.program=p,this.vertexShader=x,this.fragmentShader=w,this}var Hw=0,fp=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,i){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let i of t)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,i=t.get(e);return i===void 0&&(i=new Set,t.set(e,i)),i}_getShaderStage(e){let t=this.shaderCache,i=t.get(e);return i===void 0&&(i=new dp(e),t.set(e,i)),i}},dp=class{constructor(e){this.id=Hw++,this.code=e,this.usedTimes=0}};function Ww(n){return n===or||n===_l||n===yl}function Xw(n,e,t,i,s,r){let o=new Za,a=new fp,c=new Set,l=[],u=new Map,h=i.logarithmicDepthBuffer,f={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(_){return c.add(_),_===0?"uv":`uv${_}`}function p(_,T,F,D,P,B){let G=D.fog,N=P.geometry,V=_.isMeshStandardMaterial||_.isMeshLambertMaterial||_.isMeshPhongMaterial?D.environment:null,Y=_.isMeshStandardMaterial||_.isMeshLambertMaterial&&!_.envMap||_.isMeshPhongMaterial&&!_.envMap,z=e.get(_.envMap||V,Y),le=f[_.type],q=i.precision;_.precision!==null&&(q=i.getMaxPrecision(_.precision),q!==_.precision&&qe("WebGLProgram.getParameters:",_.precision,"not supported, using",q,"instead."));let j=N.morphAttributes.position||N.morphAttributes.normal||N.morphAttributes.color,te=j!==void 0?j.length:0,fe=0;N.morphAttributes.position!==void 0&&(fe=1),N.morphAttributes.normal!==void 0&&(fe=2),N.morphAttributes.color!==void 0&&(fe=3);let he,ee,me,ye;if(le){let Re=cs[le];he=Re.vertexShader,ee=Re.fragmentShader}else{he=_.vertexShader,ee=_.fragmentShader;let Re=a.getVertexShaderStage(_),lt=a.getFragmentShaderStage(_);a.update(_,Re,lt),me=Re.id,ye=lt.id}let we=n.getRenderTarget(),Se=n.state.buffers.depth.getReversed(),Xe=P.isInstancedMesh===!0,ot=P.isBatchedMesh===!0,Ve=!!_.map,ft=!!_.matcap,ct=!!z,it=ct&&z.isPMREMTexture===!0,Kt=!!_.aoMap,Gt=!!_.lightMap,on=!!_.bumpMap&&_.wireframe===!1,Dt=!!_.normalMap,wn=!!_.displacementMap,vt=!!_.emissiveMap,gn=!!_.metalnessMap,jt=!!_.roughnessMap,an=_.anisotropy>0,O=_.clearcoat>0,Ie=_.diffuseRoughness>0,Ze=_.dispersion>0,at=_.retroreflectivity>0,Me=_.iridescence>0,Ot=_.sheen>0,ze=_.transmission>0,Ke=an&&!!_.anisotropyMap,R=O&&!!_.clearcoatMap,v=O&&!!_.clearcoatNormalMap,X=O&&!!_.clearcoatRoughnessMap,ue=Ie&&!!_.diffuseRoughnessMap,oe=Me&&!!_.iridescenceMap,_e=Me&&!!_.iridescenceThicknessMap,xe=Ot&&!!_.sheenColorMap,ne=Ot&&!!_.sheenRoughnessMap,se=!!_.specularMap,pe=!!_.specularColorMap,U=!!_.specularIntensityMap,re=ze&&!!_.transmissionMap,ie=ze&&!!_.thicknessMap,Ee=!!_.gradientMap,ge=!!_.alphaMap,be=_.alphaTest>0,He=!!_.alphaHash,Je=!!_.extensions,ce=as;_.toneMapped&&(we===null||we.isXRRenderTarget===!0)&&(ce=n.toneMapping);let Be=it?z.isCompressedCubeTexture?z.image[0].mipmaps:z.mipmaps:null,je={shaderID:le,shaderType:_.type,shaderName:_.name,vertexShader:he,fragmentShader:ee,defines:_.defines,customVertexShaderID:me,customFragmentShaderID:ye,isRawShaderMaterial:_.isRawShaderMaterial===!0,glslVersion:_.glslVersion,precision:q,batching:ot,batchingColor:ot&&P._colorsTexture!==null,instancing:Xe,instancingColor:Xe&&P.instanceColor!==null,instancingMorph:Xe&&P.morphTexture!==null,outputColorSpace:we===null?n.outputColorSpace:we.isXRRenderTarget===!0?we.texture.colorSpace:xt.workingColorSpace,alphaToCoverage:!!_.alphaToCoverage,map:Ve,matcap:ft,envMap:ct,envMapMode:ct&&z.mapping,envMapPMREM:it,envMapMaxLod:it?Be.length-1:null,envMapSize:it?Be[0].width:null,aoMap:Kt,lightMap:Gt,bumpMap:on,normalMap:Dt,displacementMap:wn,emissiveMap:vt,normalMapObjectSpace:Dt&&_.normalMapType===ny,normalMapTangentSpace:Dt&&_.normalMapType===xl,packedNormalMap:Dt&&_.normalMapType===xl&&Ww(_.normalMap.format),metalnessMap:gn,roughnessMap:jt,anisotropy:an,anisotropyMap:Ke,clearcoat:O,clearcoatMap:R,clearcoatNormalMap:v,clearcoatRoughnessMap:X,diffuseRoughness:Ie,diffuseRoughnessMap:ue,dispersion:Ze,retroreflection:at,iridescence:Me,iridescenceMap:oe,iridescenceThicknessMap:_e,sheen:Ot,sheenColorMap:xe,sheenRoughnessMap:ne,specularMap:se,specularColorMap:pe,specularIntensityMap:U,transmission:ze,transmissionMap:re,thicknessMap:ie,gradientMap:Ee,opaque:_.transparent===!1&&_.blending===Yo&&_.alphaToCoverage===!1,alphaMap:ge,alphaTest:be,alphaHash:He,combine:_.combine,mapUv:Ve&&d(_.map.channel),aoMapUv:Kt&&d(_.aoMap.channel),lightMapUv:Gt&&d(_.lightMap.channel),bumpMapUv:on&&d(_.bumpMap.channel),normalMapUv:Dt&&d(_.normalMap.channel),displacementMapUv:wn&&d(_.displacementMap.channel),emissiveMapUv:vt&&d(_.emissiveMap.channel),metalnessMapUv:gn&&d(_.metalnessMap.channel),roughnessMapUv:jt&&d(_.roughnessMap.channel),anisotropyMapUv:Ke&&d(_.anisotropyMap.channel),clearcoatMapUv:R&&d(_.clearcoatMap.channel),clearcoatNormalMapUv:v&&d(_.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:X&&d(_.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ue&&d(_.diffuseRoughnessMap.channel),iridescenceMapUv:oe&&d(_.iridescenceMap.channel),iridescenceThicknessMapUv:_e&&d(_.iridescenceThicknessMap.channel),sheenColorMapUv:xe&&d(_.sheenColorMap.channel),sheenRoughnessMapUv:ne&&d(_.sheenRoughnessMap.channel),specularMapUv:se&&d(_.specularMap.channel),specularColorMapUv:pe&&d(_.specularColorMap.channel),specularIntensityMapUv:U&&d(_.specularIntensityMap.channel),transmissionMapUv:re&&d(_.transmissionMap.channel),thicknessMapUv:ie&&d(_.thicknessMap.channel),alphaMapUv:ge&&d(_.alphaMap.channel),vertexTangents:!!N.attributes.tangent&&(Dt||an),vertexNormals:!!N.attributes.normal,vertexColors:_.vertexColors,vertexAlphas:_.vertexColors===!0&&!!N.attributes.color&&N.attributes.color.itemSize===4,pointsUvs:P.isPoints===!0&&!!N.attributes.uv&&(Ve||ge),fog:!!G,useFog:_.fog===!0,fogExp2:!!G&&G.isFogExp2,flatShading:_.wireframe===!1&&(_.flatShading===!0||N.attributes.normal===void 0&&Dt===!1&&(_.isMeshLambertMaterial||_.isMeshPhongMaterial||_.isMeshStandardMaterial||_.isMeshPhysicalMaterial)),sizeAttenuation:_.sizeAttenuation===!0,logarithmicDepthBuffer:h,reversedDepthBuffer:Se,skinning:P.isSkinnedMesh===!0,hasPositionAttribute:N.attributes.position!==void 0,morphTargets:N.morphAttributes.position!==void 0,morphNormals:N.morphAttributes.normal!==void 0,morphColors:N.morphAttributes.color!==void 0,morphTargetsCount:te,morphTextureStride:fe,numSunLights:T.sun.length,numDirLights:T.directional.length,numPointLights:T.point.length,numSpotLights:T.spot.length,numSpotLightMaps:T.spotLightMap.length,numRectAreaLights:T.rectArea.length,numHemiLights:T.hemi.length,numSunLightShadows:T.sunShadowMap.length,numDirLightShadows:T.directionalShadowMap.length,numPointLightShadows:T.pointShadowMap.length,numSpotLightShadows:T.spotShadowMap.length,numSpotLightShadowsWithMaps:T.numSpotLightShadowsWithMaps,numLightProbes:T.numLightProbes,numLightProbeGrids:B.filter(Re=>Re.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:_.dithering,shadowMapEnabled:n.shadowMap.enabled&&F.length>0,shadowMapType:n.shadowMap.type,toneMapping:ce,decodeVideoTexture:Ve&&_.map.isVideoTexture===!0&&xt.getTransfer(_.map.colorSpace)===It,decodeVideoTextureEmissive:vt&&_.emissiveMap.isVideoTexture===!0&&xt.getTransfer(_.emissiveMap.colorSpace)===It,premultipliedAlpha:_.premultipliedAlpha,doubleSided:_.side===os,flipSided:_.side===Mn,useDepthPacking:_.depthPacking>=0,depthPacking:_.depthPacking||0,index0AttributeName:_.index0AttributeName,extensionClipCullDistance:Je&&_.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Je&&_.extensions.multiDraw===!0||ot)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:_.customProgramCacheKey()};return je.vertexUv1s=c.has(1),je.vertexUv2s=c.has(2),je.vertexUv3s=c.has(3),c.clear(),je}function S(_){let T=[];if(_.shaderID?T.push(_.shaderID):(T.push(_.customVertexShaderID),T.push(_.customFragmentShaderID)),_.defines!==void 0)for(let F in _.defines)T.push(F),T.push(_.defines[F]);return _.isRawShaderMaterial===!1&&(g(T,_),m(T,_),T.push(n.outputColorSpace)),T.push(_.customProgramCacheKey),T.join()}function g(_,T){_.push(T.precision),_.push(T.outputColorSpace),_.push(T.envMapMode),_.push(T.envMapPMREM),_.push(T.envMapMaxLod),_.push(T.envMapSize),_.push(T.mapUv),_.push(T.alphaMapUv),_.push(T.lightMapUv),_.push(T.aoMapUv),_.push(T.bumpMapUv),_.push(T.normalMapUv),_.push(T.displacementMapUv),_.push(T.emissiveMapUv),_.push(T.metalnessMapUv),_.push(T.roughnessMapUv),_.push(T.anisotropyMapUv),_.push(T.clearcoatMapUv),_.push(T.clearcoatNormalMapUv),_.push(T.clearcoatRoughnessMapUv),_.push(T.diffuseRoughnessMapUv),_.push(T.iridescenceMapUv),_.push(T.iridescenceThicknessMapUv),_.push(T.sheenColorMapUv),_.push(T.sheenRoughnessMapUv),_.push(T.specularMapUv),_.push(T.specularColorMapUv),_.push(T.specularIntensityMapUv),_.push(T.transmissionMapUv),_.push(T.thicknessMapUv),_.push(T.combine),_.push(T.fogExp2),_.push(T.sizeAttenuation),_.push(T.morphTargetsCount),_.push(T.numSunLights),_.push(T.numDirLights),_.push(T.numPointLights),_.push(T.numSpotLights),_.push(T.numSpotLightMaps),_.push(T.numHemiLights),_.push(T.numRectAreaLights),_.push(T.numSunLightShadows),_.push(T.numDirLightShadows),_.push(T.numPointLightShadows),_.push(T.numSpotLightShadows),_.push(T.numSpotLightShadowsWithMaps),_.push(T.numLightProbes),_.push(T.numLightProbeGrids),_.push(T.shadowMapType),_.push(T.toneMapping),_.push(T.numClippingPlanes),_.push(T.numClipIntersection),_.push(T.depthPacking)}function m(_,T){o.disableAll(),T.instancing&&o.enable(0),T.instancingColor&&o.enable(1),T.instancingMorph&&o.enable(2),T.matcap&&o.enable(3),T.envMap&&o.enable(4),T.normalMapObjectSpace&&o.enable(5),T.normalMapTangentSpace&&o.enable(6),T.clearcoat&&o.enable(7),T.iridescence&&o.enable(8),T.alphaTest&&o.enable(9),T.vertexColors&&o.enable(10),T.vertexAlphas&&o.enable(11),T.vertexUv1s&&o.enable(12),T.vertexUv2s&&o.enable(13),T.vertexUv3s&&o.enable(14),T.vertexTangents&&o.enable(15),T.anisotropy&&o.enable(16),T.alphaHash&&o.enable(17),T.batching&&o.enable(18),T.dispersion&&o.enable(19),T.retroreflection&&o.enable(24),T.diffuseRoughness&&o.enable(25),T.batchingColor&&o.enable(20),T.gradientMap&&o.enable(21),T.packedNormalMap&&o.enable(22),T.vertexNormals&&o.enable(23),_.push(o.mask),o.disableAll(),T.fog&&o.enable(0),T.useFog&&o.enable(1),T.flatShading&&o.enable(2),T.logarithmicDepthBuffer&&o.enable(3),T.reversedDepthBuffer&&o.enable(4),T.skinning&&o.enable(5),T.morphTargets&&o.enable(6),T.morphNormals&&o.enable(7),T.morphColors&&o.enable(8),T.premultipliedAlpha&&o.enable(9),T.shadowMapEnabled&&o.enable(10),T.doubleSided&&o.enable(11),T.flipSided&&o.enable(12),T.useDepthPacking&&o.enable(13),T.dithering&&o.enable(14),T.transmission&&o.enable(15),T.sheen&&o.enable(16),T.opaque&&o.enable(17),T.pointsUvs&&o.enable(18),T.decodeVideoTexture&&o.enable(19),T.decodeVideoTextureEmissive&&o.enable(20),T.alphaToCoverage&&o.enable(21),T.numLightProbeGrids>0&&o.enable(22),T.hasPositionAttribute&&o.enable(23),_.push(o.mask)}function b(_){let T=f[_.type],F;if(T){let D=cs[T];F=my.clone(D.uniforms)}else F=_.uniforms;return F}function I(_,T){let F=u.get(T);return F!==void 0?++F.usedTimes:(F=new Vw(n,T,_,s),l.push(F),u.set(T,F)),F}function x(_){if(--_.usedTimes===0){let T=l.indexOf(_);l[T]=l[l.length-1],l.pop(),u.delete(_.cacheKey),_.destroy()}}function w(_){a.remove(_)}function A(){a.dispose()}return{getParameters:p,getProgramCacheKey:S,getUniforms:b,acquireProgram:I,releaseProgram:x,releaseShaderCache:w,programs:l,dispose:A}}function Yw(){let n=new WeakMap;function e(o){return n.has(o)}function t(o){let a=n.get(o);return a===void 0&&(a={},n.set(o,a)),a}function i(o){n.delete(o)}function s(o,a,c){n.get(o)[a]=c}function r(){n=new WeakMap}return{has:e,get:t,remove:i,update:s,dispose:r}}function Kw(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.material.id!==e.material.id?n.material.id-e.material.id:n.materialVariant!==e.materialVariant?n.materialVariant-e.materialVariant:n.z!==e.z?n.z-e.z:n.id-e.id}function Uy(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.z!==e.z?e.z-n.z:n.id-e.id}function Oy(){let n=[],e=0,t=[],i=[],s=[];function r(){e=0,t.length=0,i.length=0,s.length=0}function o(f){let d=0;return f.isInstancedMesh&&(d+=2),f.isSkinnedMesh&&(d+=1),d}function a(f,d,p,S,g,m){let b=n[e];return b===void 0?(b={id:f.id,object:f,geometry:d,material:p,materialVariant:o(f),groupOrder:S,renderOrder:f.renderOrder,z:g,group:m},n[e]=b):(b.id=f.id,b.object=f,b.geometry=d,b.material=p,b.materialVariant=o(f),b.groupOrder=S,b.renderOrder=f.renderOrder,b.z=g,b.group=m),e++,b}function c(f,d,p,S,g,m,b){b.reversedDepth===!0&&(g=-g);let I=a(f,d,p,S,g,m);p.transmission>0?i.push(I):p.transparent===!0?s.push(I):t.push(I)}function l(f,d,p,S,g,m){let b=a(f,d,p,S,g,m);p.transmission>0?i.unshift(b):p.transparent===!0?s.unshift(b):t.unshift(b)}function u(f,d){t.length>1&&t.sort(f||Kw),i.length>1&&i.sort(d||Uy),s.length>1&&s.sort(d||Uy)}function h(){for(let f=e,d=n.length;f<d;f++){let p=n[f];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:t,transmissive:i,transparent:s,init:r,push:c,unshift:l,finish:h,sort:u}}function Zw(){let n=new WeakMap;function e(i,s){let r=n.get(i),o;return r===void 0?(o=new Oy,n.set(i,[o])):s>=r.length?(o=new Oy,r.push(o)):o=r[s],o}function t(){n=new WeakMap}return{get:e,dispose:t}}function qw(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new W,color:new rt};break;case"SpotLight":t={position:new W,direction:new W,color:new rt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new W,color:new rt,distance:0,decay:0};break;case"HemisphereLight":t={direction:new W,skyColor:new rt,groundColor:new rt};break;case"RectAreaLight":t={color:new rt,position:new W,halfWidth:new W,halfHeight:new W};break}return n[e.id]=t,t}}}function $w(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new We};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new We};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new We,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[e.id]=t,t}}}var Jw=0;function jw(n,e){return(e.castShadow?2:0)-(n.castShadow?2:0)+(e.map?1:0)-(n.map?1:0)}function Qw(n){let e=new qw,t=$w(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let l=0;l<9;l++)i.probe.push(new W);let s=new W,r=new Tt,o=new Tt;function a(l){let u=0,h=0,f=0;for(let B=0;B<9;B++)i.probe[B].set(0,0,0);let d=0,p=0,S=0,g=0,m=0,b=0,I=0,x=0,w=0,A=0,_=0,T=0,F=0,D=0;l.sort(jw);for(let B=0,G=l.length;B<G;B++){let N=l[B],V=N.color,Y=N.intensity,z=N.distance,le=null;if(N.shadow&&N.shadow.map&&(N.shadow.map.texture.format===or?le=N.shadow.map.texture:le=N.shadow.map.depthTexture||N.shadow.map.texture),N.isAmbientLight)u+=V.r*Y,h+=V.g*Y,f+=V.b*Y;else if(N.isLightProbe){for(let q=0;q<9;q++)i.probe[q].addScaledVector(N.sh.coefficients[q],Y);D++}else if(N.isSunLight){let q=e.get(N);if(q.color.copy(N.color).multiplyScalar(N.intensity),N.castShadow){let j=N.shadow,te=t.get(N);te.shadowIntensity=j.intensity,te.shadowBias=j.bias,te.shadowNormalBias=j.normalBias,te.shadowRadius=j.radius,te.shadowMapSize.copy(j.mapSize).multiply(j.getFrameExtents()),i.sunShadow[p]=te,i.sunShadowMap[p]=le;let fe=j.getViewportCount();for(let he=0;he<fe;he++)i.sunShadowMatrix[S+he]=j.getMatrix(he),i.sunShadowCascade[S+he]=j._cascadeData[he];S+=fe,p++}i.sun[d]=q,d++}else if(N.isDirectionalLight){let q=e.get(N);if(q.color.copy(N.color).multiplyScalar(N.intensity),N.castShadow){let j=N.shadow,te=t.get(N);te.shadowIntensity=j.intensity,te.shadowBias=j.bias,te.shadowNormalBias=j.normalBias,te.shadowRadius=j.radius,te.shadowMapSize=j.mapSize,i.directionalShadow[g]=te,i.directionalShadowMap[g]=le,i.directionalShadowMatrix[g]=N.shadow.matrix,w++}i.directional[g]=q,g++}else if(N.isSpotLight){let q=e.get(N);q.position.setFromMatrixPosition(N.matrixWorld),q.color.copy(V).multiplyScalar(Y),q.distance=z,q.coneCos=Math.cos(N.angle),q.penumbraCos=Math.cos(N.angle*(1-N.penumbra)),q.decay=N.decay,i.spot[b]=q;let j=N.shadow;if(N.map&&(i.spotLightMap[T]=N.map,T++,j.updateMatrices(N),N.castShadow&&F++),i.spotLightMatrix[b]=j.matrix,N.castShadow){let te=t.get(N);te.shadowIntensity=j.intensity,te.shadowBias=j.bias,te.shadowNormalBias=j.normalBias,te.shadowRadius=j.radius,te.shadowMapSize=j.mapSize,i.spotShadow[b]=te,i.spotShadowMap[b]=le,_++}b++}else if(N.isRectAreaLight){let q=e.get(N);q.color.copy(V).multiplyScalar(Y),q.halfWidth.set(N.width*.5,0,0),q.halfHeight.set(0,N.height*.5,0),i.rectArea[I]=q,I++}else if(N.isPointLight){let q=e.get(N);if(q.color.copy(N.color).multiplyScalar(N.intensity),q.distance=N.distance,q.decay=N.decay,N.castShadow){let j=N.shadow,te=t.get(N);te.shadowIntensity=j.intensity,te.shadowBias=j.bias,te.shadowNormalBias=j.normalBias,te.shadowRadius=j.radius,te.shadowMapSize=j.mapSize,te.shadowCameraNear=j.camera.near,te.shadowCameraFar=j.camera.far,i.pointShadow[m]=te,i.pointShadowMap[m]=le,i.pointShadowMatrix[m]=N.shadow.matrix,A++}i.point[m]=q,m++}else if(N.isHemisphereLight){let q=e.get(N);q.skyColor.copy(N.color).multiplyScalar(Y),q.groundColor.copy(N.groundColor).multiplyScalar(Y),i.hemi[x]=q,x++}}I>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=Ne.LTC_FLOAT_1,i.rectAreaLTC2=Ne.LTC_FLOAT_2):(i.rectAreaLTC1=Ne.LTC_HALF_1,i.rectAreaLTC2=Ne.LTC_HALF_2)),i.ambient[0]=u,i.ambient[1]=h,i.ambient[2]=f;let P=i.hash;(P.sunLength!==d||P.directionalLength!==g||P.pointLength!==m||P.spotLength!==b||P.rectAreaLength!==I||P.hemiLength!==x||P.numSunShadows!==p||P.numDirectionalShadows!==w||P.numPointShadows!==A||P.numSpotShadows!==_||P.numSpotMaps!==T||P.numLightProbes!==D)&&(i.sun.length=d,i.directional.length=g,i.spot.length=b,i.rectArea.length=I,i.point.length=m,i.hemi.length=x,i.sunShadow.length=p,i.sunShadowMap.length=p,i.sunShadowMatrix.length=S,i.sunShadowCascade.length=S,i.directionalShadow.length=w,i.directionalShadowMap.length=w,i.directionalShadowMatrix.length=w,i.pointShadow.length=A,i.pointShadowMap.length=A,i.pointShadowMatrix.length=A,i.spotShadow.length=_,i.spotShadowMap.length=_,i.spotLightMatrix.length=_+T-F,i.spotLightMap.length=T,i.numSpotLightShadowsWithMaps=F,i.numLightProbes=D,P.sunLength=d,P.directionalLength=g,P.pointLength=m,P.spotLength=b,P.rectAreaLength=I,P.hemiLength=x,P.numSunShadows=p,P.numDirectionalShadows=w,P.numPointShadows=A,P.numSpotShadows=_,P.numSpotMaps=T,P.numLightProbes=D,i.version=Jw++)}function c(l,u){let h=0,f=0,d=0,p=0,S=0,g=0,m=u.matrixWorldInverse;for(let b=0,I=l.length;b<I;b++){let x=l[b];if(x.isSunLight){let w=i.sun[h];w.direction.setFromMatrixPosition(x.matrixWorld),w.direction.transformDirection(m),h++}else if(x.isDirectionalLight){let w=i.directional[f];w.direction.setFromMatrixPosition(x.matrixWorld),s.setFromMatrixPosition(x.target.matrixWorld),w.direction.sub(s),w.direction.transformDirection(m),f++}else if(x.isSpotLight){let w=i.spot[p];w.position.setFromMatrixPosition(x.matrixWorld),w.position.applyMatrix4(m),w.direction.setFromMatrixPosition(x.matrixWorld),s.setFromMatrixPosition(x.target.matrixWorld),w.direction.sub(s),w.direction.transformDirection(m),p++}else if(x.isRectAreaLight){let w=i.rectArea[S];w.position.setFromMatrixPosition(x.matrixWorld),w.position.applyMatrix4(m),o.identity(),r.copy(x.matrixWorld),r.premultiply(m),o.extractRotation(r),w.halfWidth.set(x.width*.5,0,0),w.halfHeight.set(0,x.height*.5,0),w.halfWidth.applyMatrix4(o),w.halfHeight.applyMatrix4(o),S++}else if(x.isPointLight){let w=i.point[d];w.position.setFromMatrixPosition(x.matrixWorld),w.position.applyMatrix4(m),d++}else if(x.isHemisphereLight){let w=i.hemi[g];w.direction.setFromMatrixPosition(x.matrixWorld),w.direction.transformDirection(m),g++}}}return{setup:a,setupView:c,state:i}}function Fy(n){let e=new Qw(n),t=[],i=[],s=[];function r(h){u.camera=h,t.length=0,i.length=0,s.length=0}function o(h){h.isLightProbeGrid?s.push(h):t.push(h)}function a(h){i.push(h)}function c(){e.setup(t),s.sort((h,f)=>h.priority-f.priority||h.id-f.id)}function l(h){e.setupView(t,h)}let u={lightsArray:t,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:u,setupLights:c,setupLightsView:l,pushLight:o,pushShadow:a}}function eR(n){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new Fy(n),e.set(s,[a])):r>=o.length?(a=new Fy(n),o.push(a)):a=o[r],a}function i(){e=new WeakMap}return{get:t,dispose:i}}var tR=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,nR=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,iR=[new W(1,0,0),new W(-1,0,0),new W(0,1,0),new W(0,-1,0),new W(0,0,1),new W(0,0,-1)],sR=[new W(0,-1,0),new W(0,-1,0),new W(0,0,1),new W(0,0,-1),new W(0,-1,0),new W(0,-1,0)],By=new Tt,vl=new W,ap=new W;function rR(n,e,t){let i=new js,s=new We,r=new We,o=new qt,a=new tu,c=new nu,l={},u=t.maxTextureSize,h={[rr]:Mn,[Mn]:rr,[os]:os},f=new rs({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new We},radius:{value:4}},vertexShader:tR,fragmentShader:nR}),d=f.clone();d.defines.HORIZONTAL_PASS=1;let p=new Qn;p.setAttribute("position",new mn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let S=new Ct(p,f),g=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Cr;let m=this.type;this.render=function(A,_,T){if(g.enabled===!1||g.autoUpdate===!1&&g.needsUpdate===!1||A.length===0)return;this.type===L_&&(qe("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Cr);let F=n.getRenderTarget(),D=n.getActiveCubeFace(),P=n.getActiveMipmapLevel(),B=n.state;B.setBlending(Pr),B.buffers.depth.getReversed()===!0?B.buffers.color.setClear(0,0,0,0):B.buffers.color.setClear(1,1,1,1),B.buffers.depth.setTest(!0),B.setScissorTest(!1);let G=m!==this.type;G&&_.traverse(function(N){N.material&&(Array.isArray(N.material)?N.material.forEach(V=>V.needsUpdate=!0):N.material.needsUpdate=!0)});for(let N=0,V=A.length;N<V;N++){let Y=A[N],z=Y.shadow;if(z===void 0){qe("WebGLShadowMap:",Y,"has no shadow.");continue}if(z.autoUpdate===!1&&z.needsUpdate===!1)continue;s.copy(z.mapSize);let le=z.getFrameExtents();s.multiply(le),r.copy(z.mapSize),(s.x>u||s.y>u)&&(s.x>u&&(r.x=Math.floor(u/le.x),s.x=r.x*le.x,z.mapSize.x=r.x),s.y>u&&(r.y=Math.floor(u/le.y),s.y=r.y*le.y,z.mapSize.y=r.y));let q=n.state.buffers.depth.getReversed();if(z.camera._reversedDepth=q,z.map===null||G===!0){if(z.map!==null&&(z.map.depthTexture!==null&&(z.map.depthTexture.dispose(),z.map.depthTexture=null),z.map.dispose()),this.type===Xo){if(Y.isPointLight){qe("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}z.map=new di(s.x,s.y,{format:or,type:Vi,minFilter:Jn,magFilter:Jn,generateMipmaps:!1}),z.map.texture.name=Y.name+".shadowMap",z.map.depthTexture=new Rs(s.x,s.y,Ai),z.map.depthTexture.name=Y.name+".shadowMapDepth",z.map.depthTexture.format=ws,z.map.depthTexture.compareFunction=null,z.map.depthTexture.minFilter=Ln,z.map.depthTexture.magFilter=Ln}else Y.isPointLight?(z.map=new Sl(s.x),z.map.depthTexture=new el(s.x,zi)):(z.map=new di(s.x,s.y),z.map.depthTexture=new Rs(s.x,s.y,zi)),z.map.depthTexture.name=Y.name+".shadowMap",z.map.depthTexture.format=ws,this.type===Cr?(z.map.depthTexture.compareFunction=q?Zd:Kd,z.map.depthTexture.minFilter=Jn,z.map.depthTexture.magFilter=Jn):(z.map.depthTexture.compareFunction=null,z.map.depthTexture.minFilter=Ln,z.map.depthTexture.magFilter=Ln);z.camera.updateProjectionMatrix()}z.map.isWebGLCubeRenderTarget!==!0&&(z.map.width!==s.x||z.map.height!==s.y)&&z.map.setSize(s.x,s.y);let j=z.map.isWebGLCubeRenderTarget?6:z.getViewportCount();Y.isPointLight!==!0&&z.updateMatrices(Y,T);let te=(z.camera.layers.mask&4294967294)!==0?z.camera.layers:T.layers;for(let fe=0;fe<j;fe++){let he=z.getCamera(fe);if(Y.isPointLight){let ee=z.camera,me=z.matrix,ye=Y.distance||ee.far;ye!==ee.far&&(ee.far=ye,ee.updateProjectionMatrix()),vl.setFromMatrixPosition(Y.matrixWorld),ee.position.copy(vl),ap.copy(ee.position),ap.add(iR[fe]),ee.up.copy(sR[fe]),ee.lookAt(ap),ee.updateMatrixWorld(),me.makeTranslation(-vl.x,-vl.y,-vl.z),By.multiplyMatrices(ee.projectionMatrix,ee.matrixWorldInverse),z._frustum.setFromProjectionMatrix(By,ee.coordinateSystem,ee.reversedDepth)}if(z.map.isWebGLCubeRenderTarget)n.setRenderTarget(z.map,fe),n.clear();else{fe===0&&(n.setRenderTarget(z.map),n.clear());let ee=z.getViewport(fe);o.set(r.x*ee.x,r.y*ee.y,r.x*ee.z,r.y*ee.w),B.viewport(o)}i=z.getFrustum(fe),x(_,T,he,Y,te,this.type)}z.isPointLightShadow!==!0&&this.type===Xo&&b(z,T),z.needsUpdate=!1}m=this.type,g.needsUpdate=!1,n.setRenderTarget(F,D,P)};function b(A,_){let T=e.update(S);f.defines.VSM_SAMPLES!==A.blurSamples&&(f.defines.VSM_SAMPLES=A.blurSamples,d.defines.VSM_SAMPLES=A.blurSamples,f.needsUpdate=!0,d.needsUpdate=!0),A.mapPass===null?A.mapPass=new di(s.x,s.y,{format:or,type:Vi}):(A.mapPass.width!==A.map.width||A.mapPass.height!==A.map.height)&&A.mapPass.setSize(A.map.width,A.map.height),f.uniforms.shadow_pass.value=A.map.depthTexture,f.uniforms.resolution.value.set(A.map.width,A.map.height),f.uniforms.radius.value=A.radius,n.setRenderTarget(A.mapPass),n.clear(),n.renderBufferDirect(_,null,T,f,S,null),d.uniforms.shadow_pass.value=A.mapPass.texture,d.uniforms.resolution.value.set(A.map.width,A.map.height),d.uniforms.radius.value=A.radius,n.setRenderTarget(A.map),n.clear(),n.renderBufferDirect(_,null,T,d,S,null)}function I(A,_,T,F){let D=null,P=T.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(P!==void 0)D=P;else if(D=T.isPointLight===!0?c:a,n.localClippingEnabled&&_.clipShadows===!0&&Array.isArray(_.clippingPlanes)&&_.clippingPlanes.length!==0||_.displacementMap&&_.displacementScale!==0||_.alphaMap&&_.alphaTest>0||_.map&&_.alphaTest>0||_.alphaToCoverage===!0){let B=D.uuid,G=_.uuid,N=l[B];N===void 0&&(N={},l[B]=N);let V=N[G];V===void 0&&(V=D.clone(),N[G]=V,_.addEventListener("dispose",w)),D=V}if(D.visible=_.visible,D.wireframe=_.wireframe,F===Xo?D.side=_.shadowSide!==null?_.shadowSide:_.side:D.side=_.shadowSide!==null?_.shadowSide:h[_.side],D.alphaMap=_.alphaMap,D.alphaTest=_.alphaToCoverage===!0?.5:_.alphaTest,D.map=_.map,D.clipShadows=_.clipShadows,D.clippingPlanes=_.clippingPlanes,D.clipIntersection=_.clipIntersection,D.displacementMap=_.displacementMap,D.displacementScale=_.displacementScale,D.displacementBias=_.displacementBias,D.wireframeLinewidth=_.wireframeLinewidth,D.linewidth=_.linewidth,T.isPointLight===!0&&D.isMeshDistanceMaterial===!0){let B=n.properties.get(D);B.light=T}return D}function x(A,_,T,F,D,P){if(A.visible===!1)return;if(A.layers.test(D)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&P===Xo)&&(!A.frustumCulled||A.intersectsFrustum(i))){A.modelViewMatrix.multiplyMatrices(T.matrixWorldInverse,A.matrixWorld);let N=e.update(A),V=A.material;if(Array.isArray(V)){let Y=N.groups;for(let z=0,le=Y.length;z<le;z++){let q=Y[z],j=V[q.materialIndex];if(j&&j.visible){let te=I(A,j,F,P);A.onBeforeShadow(n,A,_,T,N,te,q),n.renderBufferDirect(T,null,N,te,A,q),A.onAfterShadow(n,A,_,T,N,te,q)}}}else if(V.visible){let Y=I(A,V,F,P);A.onBeforeShadow(n,A,_,T,N,Y,null),n.renderBufferDirect(T,null,N,Y,A,null),A.onAfterShadow(n,A,_,T,N,Y,null)}}let G=A.children;for(let N=0,V=G.length;N<V;N++)x(G[N],_,T,F,D,P)}function w(A){A.target.removeEventListener("dispose",w);for(let T in l){let F=l[T],D=A.target.uuid;D in F&&(F[D].dispose(),delete F[D])}}}function oR(n,e){function t(){let U=!1,re=new qt,ie=null,Ee=new qt(0,0,0,0);return{setMask:function(ge){ie!==ge&&!U&&(n.colorMask(ge,ge,ge,ge),ie=ge)},setLocked:function(ge){U=ge},setClear:function(ge,be,He,Je,ce){ce===!0&&(ge*=Je,be*=Je,He*=Je),re.set(ge,be,He,Je),Ee.equals(re)===!1&&(n.clearColor(ge,be,He,Je),Ee.copy(re))},reset:function(){U=!1,ie=null,Ee.set(-1,0,0,0)}}}function i(){let U=!1,re=!1,ie=null,Ee=null,ge=null;return{setReversed:function(be){if(re!==be){let He=e.get("EXT_clip_control");be?He.clipControlEXT(He.LOWER_LEFT_EXT,He.ZERO_TO_ONE_EXT):He.clipControlEXT(He.LOWER_LEFT_EXT,He.NEGATIVE_ONE_TO_ONE_EXT),re=be;let Je=ge;ge=null,this.setClear(Je)}},getReversed:function(){return re},setTest:function(be){be?Se(n.DEPTH_TEST):Xe(n.DEPTH_TEST)},setMask:function(be){ie!==be&&!U&&(n.depthMask(be),ie=be)},setFunc:function(be){if(re&&(be=fy[be]),Ee!==be){switch(be){case Gc:n.depthFunc(n.NEVER);break;case zc:n.depthFunc(n.ALWAYS);break;case Vc:n.depthFunc(n.LESS);break;case Po:n.depthFunc(n.LEQUAL);break;case Hc:n.depthFunc(n.EQUAL);break;case Wc:n.depthFunc(n.GEQUAL);break;case Xc:n.depthFunc(n.GREATER);break;case Yc:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}Ee=be}},setLocked:function(be){U=be},setClear:function(be){ge!==be&&(ge=be,re&&(be=1-be),n.clearDepth(be))},reset:function(){U=!1,ie=null,Ee=null,ge=null,re=!1}}}function s(){let U=!1,re=null,ie=null,Ee=null,ge=null,be=null,He=null,Je=null,ce=null;return{setTest:function(Be){U||(Be?Se(n.STENCIL_TEST):Xe(n.STENCIL_TEST))},setMask:function(Be){re!==Be&&!U&&(n.stencilMask(Be),re=Be)},setFunc:function(Be,je,Re){(ie!==Be||Ee!==je||ge!==Re)&&(n.stencilFunc(Be,je,Re),ie=Be,Ee=je,ge=Re)},setOp:function(Be,je,Re){(be!==Be||He!==je||Je!==Re)&&(n.stencilOp(Be,je,Re),be=Be,He=je,Je=Re)},setLocked:function(Be){U=Be},setClear:function(Be){ce!==Be&&(n.clearStencil(Be),ce=Be)},reset:function(){U=!1,re=null,ie=null,Ee=null,ge=null,be=null,He=null,Je=null,ce=null}}}let r=new t,o=new i,a=new s,c={},l=new WeakMap,u={},h={},f={},d=new WeakMap,p=[],S=null,g=!1,m=null,b=null,I=null,x=null,w=null,A=null,_=null,T=new rt(0,0,0),F=0,D=!1,P=null,B=null,G=null,N=null,V=null,Y=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),z=!1,le=0,q=n.getParameter(n.VERSION);q.indexOf("WebGL")!==-1?(le=parseFloat(/^WebGL (\d)/.exec(q)[1]),z=le>=1):q.indexOf("OpenGL ES")!==-1&&(le=parseFloat(/^OpenGL ES (\d)/.exec(q)[1]),z=le>=2);let j=null,te={},fe=n.getParameter(n.SCISSOR_BOX),he=n.getParameter(n.VIEWPORT),ee=new qt().fromArray(fe),me=new qt().fromArray(he);function ye(U,re,ie,Ee){let ge=new Uint8Array(4),be=n.createTexture();n.bindTexture(U,be),n.texParameteri(U,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(U,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let He=0;He<ie;He++)U===n.TEXTURE_3D||U===n.TEXTURE_2D_ARRAY?n.texImage3D(re,0,n.RGBA,1,1,Ee,0,n.RGBA,n.UNSIGNED_BYTE,ge):n.texImage2D(re+He,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,ge);return be}let we={};we[n.TEXTURE_2D]=ye(n.TEXTURE_2D,n.TEXTURE_2D,1),we[n.TEXTURE_CUBE_MAP]=ye(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),we[n.TEXTURE_2D_ARRAY]=ye(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),we[n.TEXTURE_3D]=ye(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),Se(n.DEPTH_TEST),o.setFunc(Po),on(!1),Dt(Rd),Se(n.CULL_FACE),Kt(Pr);function Se(U){u[U]!==!0&&(n.enable(U),u[U]=!0)}function Xe(U){u[U]!==!1&&(n.disable(U),u[U]=!1)}function ot(U,re){return f[U]!==re?(n.bindFramebuffer(U,re),f[U]=re,U===n.DRAW_FRAMEBUFFER&&(f[n.FRAMEBUFFER]=re),U===n.FRAMEBUFFER&&(f[n.DRAW_FRAMEBUFFER]=re),!0):!1}function Ve(U,re){let ie=p,Ee=!1;if(U){ie=d.get(re),ie===void 0&&(ie=[],d.set(re,ie));let ge=U.textures;if(ie.length!==ge.length||ie[0]!==n.COLOR_ATTACHMENT0){for(let be=0,He=ge.length;be<He;be++)ie[be]=n.COLOR_ATTACHMENT0+be;ie.length=ge.length,Ee=!0}}else ie[0]!==n.BACK&&(ie[0]=n.BACK,Ee=!0);Ee&&n.drawBuffers(ie)}function ft(U){return S!==U?(n.useProgram(U),S=U,!0):!1}let ct={[Nr]:n.FUNC_ADD,[U_]:n.FUNC_SUBTRACT,[O_]:n.FUNC_REVERSE_SUBTRACT};ct[F_]=n.MIN,ct[B_]=n.MAX;let it={[k_]:n.ZERO,[G_]:n.ONE,[z_]:n.SRC_COLOR,[Nd]:n.SRC_ALPHA,[K_]:n.SRC_ALPHA_SATURATE,[X_]:n.DST_COLOR,[H_]:n.DST_ALPHA,[V_]:n.ONE_MINUS_SRC_COLOR,[Ld]:n.ONE_MINUS_SRC_ALPHA,[Y_]:n.ONE_MINUS_DST_COLOR,[W_]:n.ONE_MINUS_DST_ALPHA,[Z_]:n.CONSTANT_COLOR,[q_]:n.ONE_MINUS_CONSTANT_COLOR,[$_]:n.CONSTANT_ALPHA,[J_]:n.ONE_MINUS_CONSTANT_ALPHA};function Kt(U,re,ie,Ee,ge,be,He,Je,ce,Be){if(U===Pr){g===!0&&(Xe(n.BLEND),g=!1);return}if(g===!1&&(Se(n.BLEND),g=!0),U!==D_){if(U!==m||Be!==D){if((b!==Nr||w!==Nr)&&(n.blendEquation(n.FUNC_ADD),b=Nr,w=Nr),Be)switch(U){case Yo:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Id:n.blendFunc(n.ONE,n.ONE);break;case Cd:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case Pd:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:Qe("WebGLState: Invalid blending: ",U);break}else switch(U){case Yo:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Id:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case Cd:Qe("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Pd:Qe("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Qe("WebGLState: Invalid blending: ",U);break}I=null,x=null,A=null,_=null,T.set(0,0,0),F=0,m=U,D=Be}return}ge=ge||re,be=be||ie,He=He||Ee,(re!==b||ge!==w)&&(n.blendEquationSeparate(ct[re],ct[ge]),b=re,w=ge),(ie!==I||Ee!==x||be!==A||He!==_)&&(n.blendFuncSeparate(it[ie],it[Ee],it[be],it[He]),I=ie,x=Ee,A=be,_=He),(Je.equals(T)===!1||ce!==F)&&(n.blendColor(Je.r,Je.g,Je.b,ce),T.copy(Je),F=ce),m=U,D=!1}function Gt(U,re){U.side===os?Xe(n.CULL_FACE):Se(n.CULL_FACE);let ie=U.side===Mn;re&&(ie=!ie),on(ie),U.blending===Yo&&U.transparent===!1?Kt(Pr):Kt(U.blending,U.blendEquation,U.blendSrc,U.blendDst,U.blendEquationAlpha,U.blendSrcAlpha,U.blendDstAlpha,U.blendColor,U.blendAlpha,U.premultipliedAlpha),o.setFunc(U.depthFunc),o.setTest(U.depthTest),o.setMask(U.depthWrite),r.setMask(U.colorWrite);let Ee=U.stencilWrite;a.setTest(Ee),Ee&&(a.setMask(U.stencilWriteMask),a.setFunc(U.stencilFunc,U.stencilRef,U.stencilFuncMask),a.setOp(U.stencilFail,U.stencilZFail,U.stencilZPass)),vt(U.polygonOffset,U.polygonOffsetFactor,U.polygonOffsetUnits),U.alphaToCoverage===!0?Se(n.SAMPLE_ALPHA_TO_COVERAGE):Xe(n.SAMPLE_ALPHA_TO_COVERAGE)}function on(U){P!==U&&(U?n.frontFace(n.CW):n.frontFace(n.CCW),P=U)}function Dt(U){U!==P_?(Se(n.CULL_FACE),U!==B&&(U===Rd?n.cullFace(n.BACK):U===N_?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):Xe(n.CULL_FACE),B=U}function wn(U){U!==G&&(z&&n.lineWidth(U),G=U)}function vt(U,re,ie){U?(Se(n.POLYGON_OFFSET_FILL),(N!==re||V!==ie)&&(N=re,V=ie,o.getReversed()&&(re=-re,ie=-ie),n.polygonOffset(re,ie))):Xe(n.POLYGON_OFFSET_FILL)}function gn(U){U?Se(n.SCISSOR_TEST):Xe(n.SCISSOR_TEST)}function jt(U){U===void 0&&(U=n.TEXTURE0+Y-1),j!==U&&(n.activeTexture(U),j=U)}function an(U,re,ie){ie===void 0&&(j===null?ie=n.TEXTURE0+Y-1:ie=j);let Ee=te[ie];Ee===void 0&&(Ee={type:void 0,texture:void 0},te[ie]=Ee),(Ee.type!==U||Ee.texture!==re)&&(j!==ie&&(n.activeTexture(ie),j=ie),n.bindTexture(U,re||we[U]),Ee.type=U,Ee.texture=re)}function O(){let U=te[j];U!==void 0&&U.type!==void 0&&(n.bindTexture(U.type,null),U.type=void 0,U.texture=void 0)}function Ie(){try{n.compressedTexImage2D(...arguments)}catch(U){Qe("WebGLState:",U)}}function Ze(){try{n.compressedTexImage3D(...arguments)}catch(U){Qe("WebGLState:",U)}}function at(){try{n.texSubImage2D(...arguments)}catch(U){Qe("WebGLState:",U)}}function Me(){try{n.texSubImage3D(...arguments)}catch(U){Qe("WebGLState:",U)}}function Ot(){try{n.compressedTexSubImage2D(...arguments)}catch(U){Qe("WebGLState:",U)}}function ze(){try{n.compressedTexSubImage3D(...arguments)}catch(U){Qe("WebGLState:",U)}}function Ke(){try{n.texStorage2D(...arguments)}catch(U){Qe("WebGLState:",U)}}function R(){try{n.texStorage3D(...arguments)}catch(U){Qe("WebGLState:",U)}}function v(){try{n.texImage2D(...arguments)}catch(U){Qe("WebGLState:",U)}}function X(){try{n.texImage3D(...arguments)}catch(U){Qe("WebGLState:",U)}}function ue(U){return h[U]!==void 0?h[U]:n.getParameter(U)}function oe(U,re){h[U]!==re&&(n.pixelStorei(U,re),h[U]=re)}function _e(U){ee.equals(U)===!1&&(n.scissor(U.x,U.y,U.z,U.w),ee.copy(U))}function xe(U){me.equals(U)===!1&&(n.viewport(U.x,U.y,U.z,U.w),me.copy(U))}function ne(U,re){let ie=l.get(re);ie===void 0&&(ie=new WeakMap,l.set(re,ie));let Ee=ie.get(U);Ee===void 0&&(Ee=n.getUniformBlockIndex(re,U.name),n.uniformBlockBinding(re,Ee,Ee),ie.set(U,Ee))}function se(U,re,ie){let ge=l.get(re).get(U);c[ge]!==ie&&(n.bindBufferBase(n.UNIFORM_BUFFER,ge,ie),c[ge]=ie)}function pe(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),o.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),u={},h={},j=null,te={},f={},c={},d=new WeakMap,p=[],S=null,g=!1,m=null,b=null,I=null,x=null,w=null,A=null,_=null,T=new rt(0,0,0),F=0,D=!1,P=null,B=null,G=null,N=null,V=null,ee.set(0,0,n.canvas.width,n.canvas.height),me.set(0,0,n.canvas.width,n.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:Se,disable:Xe,bindFramebuffer:ot,drawBuffers:Ve,useProgram:ft,setBlending:Kt,setMaterial:Gt,setFlipSided:on,setCullFace:Dt,setLineWidth:wn,setPolygonOffset:vt,setScissorTest:gn,activeTexture:jt,bindTexture:an,unbindTexture:O,compressedTexImage2D:Ie,compressedTexImage3D:Ze,texImage2D:v,texImage3D:X,pixelStorei:oe,getParameter:ue,updateUBOMapping:ne,uniformBlockBinding:se,texStorage2D:Ke,texStorage3D:R,texSubImage2D:at,texSubImage3D:Me,compressedTexSubImage2D:Ot,compressedTexSubImage3D:ze,scissor:_e,viewport:xe,reset:pe}}function aR(n,e,t,i,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,c=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),l=new We,u=new WeakMap,h=new Set,f,d=new WeakMap,p=new Set,S=new FinalizationRegistry(R=>p.delete(R)),g=!1;try{g=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function m(R,v){return g?new OffscreenCanvas(R,v):Xa("canvas")}function b(R,v,X){let ue=1,oe=Ke(R);if((oe.width>X||oe.height>X)&&(ue=X/Math.max(oe.width,oe.height)),ue<1)if(typeof HTMLImageElement<"u"&&R instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&R instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&R instanceof ImageBitmap||typeof VideoFrame<"u"&&R instanceof VideoFrame){let _e=Math.floor(ue*oe.width),xe=Math.floor(ue*oe.height);f===void 0&&(f=m(_e,xe));let ne=v?m(_e,xe):f;return ne.width=_e,ne.height=xe,ne.getContext("2d").drawImage(R,0,0,_e,xe),qe("WebGLRenderer: Texture has been resized from ("+oe.width+"x"+oe.height+") to ("+_e+"x"+xe+")."),ne}else return"data"in R&&qe("WebGLRenderer: Image in DataTexture is too big ("+oe.width+"x"+oe.height+")."),R;return R}function I(R){return R.generateMipmaps}function x(R){n.generateMipmap(R)}function w(R){return R.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:R.isWebGL3DRenderTarget?n.TEXTURE_3D:R.isWebGLArrayRenderTarget||R.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function A(R,v,X,ue,oe,_e=!1){if(R!==null){if(n[R]!==void 0)return n[R];qe("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+R+"'")}let xe;ue&&(xe=e.get("EXT_texture_norm16"),xe||qe("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ne=v;if(v===n.RED&&(X===n.FLOAT&&(ne=n.R32F),X===n.HALF_FLOAT&&(ne=n.R16F),X===n.UNSIGNED_BYTE&&(ne=n.R8),X===n.UNSIGNED_SHORT&&xe&&(ne=xe.R16_EXT),X===n.SHORT&&xe&&(ne=xe.R16_SNORM_EXT)),v===n.RED_INTEGER&&(X===n.UNSIGNED_BYTE&&(ne=n.R8UI),X===n.UNSIGNED_SHORT&&(ne=n.R16UI),X===n.UNSIGNED_INT&&(ne=n.R32UI),X===n.BYTE&&(ne=n.R8I),X===n.SHORT&&(ne=n.R16I),X===n.INT&&(ne=n.R32I)),v===n.RG&&(X===n.FLOAT&&(ne=n.RG32F),X===n.HALF_FLOAT&&(ne=n.RG16F),X===n.UNSIGNED_BYTE&&(ne=n.RG8),X===n.UNSIGNED_SHORT&&xe&&(ne=xe.RG16_EXT),X===n.SHORT&&xe&&(ne=xe.RG16_SNORM_EXT)),v===n.RG_INTEGER&&(X===n.UNSIGNED_BYTE&&(ne=n.RG8UI),X===n.UNSIGNED_SHORT&&(ne=n.RG16UI),X===n.UNSIGNED_INT&&(ne=n.RG32UI),X===n.BYTE&&(ne=n.RG8I),X===n.SHORT&&(ne=n.RG16I),X===n.INT&&(ne=n.RG32I)),v===n.RGB_INTEGER&&(X===n.UNSIGNED_BYTE&&(ne=n.RGB8UI),X===n.UNSIGNED_SHORT&&(ne=n.RGB16UI),X===n.UNSIGNED_INT&&(ne=n.RGB32UI),X===n.BYTE&&(ne=n.RGB8I),X===n.SHORT&&(ne=n.RGB16I),X===n.INT&&(ne=n.RGB32I)),v===n.RGBA_INTEGER&&(X===n.UNSIGNED_BYTE&&(ne=n.RGBA8UI),X===n.UNSIGNED_SHORT&&(ne=n.RGBA16UI),X===n.UNSIGNED_INT&&(ne=n.RGBA32UI),X===n.BYTE&&(ne=n.RGBA8I),X===n.SHORT&&(ne=n.RGBA16I),X===n.INT&&(ne=n.RGBA32I)),v===n.RGB&&(X===n.UNSIGNED_SHORT&&xe&&(ne=xe.RGB16_EXT),X===n.SHORT&&xe&&(ne=xe.RGB16_SNORM_EXT),X===n.UNSIGNED_INT_5_9_9_9_REV&&(ne=n.RGB9_E5),X===n.UNSIGNED_INT_10F_11F_11F_REV&&(ne=n.R11F_G11F_B10F)),v===n.RGBA){let se=_e?Wa:xt.getTransfer(oe);X===n.FLOAT&&(ne=n.RGBA32F),X===n.HALF_FLOAT&&(ne=n.RGBA16F),X===n.UNSIGNED_BYTE&&(ne=se===It?n.SRGB8_ALPHA8:n.RGBA8),X===n.UNSIGNED_SHORT&&xe&&(ne=xe.RGBA16_EXT),X===n.SHORT&&xe&&(ne=xe.RGBA16_SNORM_EXT),X===n.UNSIGNED_SHORT_4_4_4_4&&(ne=n.RGBA4),X===n.UNSIGNED_SHORT_5_5_5_1&&(ne=n.RGB5_A1)}return(ne===n.R16F||ne===n.R32F||ne===n.RG16F||ne===n.RG32F||ne===n.RGBA16F||ne===n.RGBA32F)&&e.get("EXT_color_buffer_float"),ne}function _(R,v){let X;return R?v===null||v===zi||v===Dr?X=n.DEPTH24_STENCIL8:v===Ai?X=n.DEPTH32F_STENCIL8:v===Zo&&(X=n.DEPTH24_STENCIL8,qe("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):v===null||v===zi||v===Dr?X=n.DEPTH_COMPONENT24:v===Ai?X=n.DEPTH_COMPONENT32F:v===Zo&&(X=n.DEPTH_COMPONENT16),X}function T(R,v){return I(R)===!0||R.isFramebufferTexture&&R.minFilter!==Ln&&R.minFilter!==Jn?Math.log2(Math.max(v.width,v.height))+1:R.mipmaps.length>0?R.mipmaps.length:R.isCompressedTexture&&Array.isArray(R.image)?v.mipmaps.length:1}function F(R){let v=new WeakRef(R);i.get(R).__ref=v,p.add(v),S.register(R,v,v)}function D(R){let v=i.get(R).__ref;v!==void 0&&(p.delete(v),S.unregister(v))}function P(R){G(R.target)}function B(R){N(R.target)}function G(R){R.removeEventListener("dispose",P),D(R),Y(R),R.isVideoTexture&&u.delete(R),R.isHTMLTexture&&h.delete(R)}function N(R){R.removeEventListener("dispose",B),D(R),le(R)}function V(){for(let R of p){let v=R.deref();v!==void 0&&(v.isRenderTarget===!0?N(v):G(v))}p.clear(),h.clear()}function Y(R){let v=i.get(R);if(v.__webglInit===void 0)return;let X=R.source,ue=d.get(X);if(ue){let oe=ue[v.__cacheKey];oe.usedTimes--,oe.usedTimes===0&&z(R),Object.keys(ue).length===0&&d.delete(X)}i.remove(R)}function z(R){let v=i.get(R);n.deleteTexture(v.__webglTexture);let X=R.source,ue=d.get(X);delete ue[v.__cacheKey],o.memory.textures--}function le(R){let v=i.get(R);v.__depthDisposeCallback&&v.__depthDisposeCallback();let X=R.depthTexture;if(X&&X.renderTarget===R&&G(X),R.isWebGLCubeRenderTarget)for(let oe=0;oe<6;oe++){if(Array.isArray(v.__webglFramebuffer[oe]))for(let _e=0;_e<v.__webglFramebuffer[oe].length;_e++)n.deleteFramebuffer(v.__webglFramebuffer[oe][_e]);else n.deleteFramebuffer(v.__webglFramebuffer[oe]);v.__webglDepthbuffer&&n.deleteRenderbuffer(v.__webglDepthbuffer[oe])}else{if(Array.isArray(v.__webglFramebuffer))for(let oe=0;oe<v.__webglFramebuffer.length;oe++)n.deleteFramebuffer(v.__webglFramebuffer[oe]);else n.deleteFramebuffer(v.__webglFramebuffer);if(v.__webglDepthbuffer&&n.deleteRenderbuffer(v.__webglDepthbuffer),v.__webglMultisampledFramebuffer&&n.deleteFramebuffer(v.__webglMultisampledFramebuffer),v.__webglColorRenderbuffer)for(let oe=0;oe<v.__webglColorRenderbuffer.length;oe++)v.__webglColorRenderbuffer[oe]&&n.deleteRenderbuffer(v.__webglColorRenderbuffer[oe]);v.__webglDepthRenderbuffer&&n.deleteRenderbuffer(v.__webglDepthRenderbuffer)}let ue=R.textures;for(let oe=0,_e=ue.length;oe<_e;oe++){let xe=i.get(ue[oe]);xe.__webglTexture&&(n.deleteTexture(xe.__webglTexture),o.memory.textures--),i.remove(ue[oe])}i.remove(R)}let q=0;function j(){q=0}function te(){return q}function fe(R){q=R}function he(){let R=q;return R>=s.maxTextures&&qe("WebGLTextures: Trying to use "+(R+1)+" texture units while this GPU supports only "+s.maxTextures),q+=1,R}function ee(R){let v=[];return v.push(R.wrapS),v.push(R.wrapT),v.push(R.wrapR||0),v.push(R.magFilter),v.push(R.minFilter),v.push(R.anisotropy),v.push(R.internalFormat),v.push(R.format),v.push(R.type),v.push(R.generateMipmaps),v.push(R.mipmapsAutoUpdate),v.push(R.premultiplyAlpha),v.push(R.flipY),v.push(R.unpackAlignment),v.push(R.colorSpace),v.join()}function me(R,v){let X=i.get(R);if(R.isVideoTexture&&Ot(R),R.isRenderTargetTexture===!1&&R.isExternalTexture!==!0&&R.version>0&&X.__version!==R.version){let ue=R.image;if(ue===null)qe("WebGLRenderer: Texture marked for update but no image data found.");else if(ue.complete===!1)qe("WebGLRenderer: Texture marked for update but image is incomplete");else{Gt(X,R,v);return}}else R.isExternalTexture&&(X.__webglTexture=R.sourceTexture?R.sourceTexture:null);t.bindTexture(n.TEXTURE_2D,X.__webglTexture,n.TEXTURE0+v)}function ye(R,v){let X=i.get(R);if(R.isRenderTargetTexture===!1&&R.version>0&&X.__version!==R.version){Gt(X,R,v);return}else R.isExternalTexture&&(X.__webglTexture=R.sourceTexture?R.sourceTexture:null);t.bindTexture(n.TEXTURE_2D_ARRAY,X.__webglTexture,n.TEXTURE0+v)}function we(R,v){let X=i.get(R);if(R.isRenderTargetTexture===!1&&R.version>0&&X.__version!==R.version){Gt(X,R,v);return}t.bindTexture(n.TEXTURE_3D,X.__webglTexture,n.TEXTURE0+v)}function Se(R,v){let X=i.get(R);if(R.version>0&&X.__version!==R.version){on(X,R,v);return}t.bindTexture(n.TEXTURE_CUBE_MAP,X.__webglTexture,n.TEXTURE0+v)}let Xe={[Kc]:n.REPEAT,[ns]:n.CLAMP_TO_EDGE,[Zc]:n.MIRRORED_REPEAT},ot={[Ln]:n.NEAREST,[ey]:n.NEAREST_MIPMAP_NEAREST,[fl]:n.NEAREST_MIPMAP_LINEAR,[Jn]:n.LINEAR,[_u]:n.LINEAR_MIPMAP_NEAREST,[Is]:n.LINEAR_MIPMAP_LINEAR},Ve={[sy]:n.NEVER,[qd]:n.ALWAYS,[ry]:n.LESS,[Kd]:n.LEQUAL,[oy]:n.EQUAL,[Zd]:n.GEQUAL,[ay]:n.GREATER,[ly]:n.NOTEQUAL};function ft(R,v){if(v.type===Ai&&e.has("OES_texture_float_linear")===!1&&(v.magFilter===Jn||v.magFilter===_u||v.magFilter===fl||v.magFilter===Is||v.minFilter===Jn||v.minFilter===_u||v.minFilter===fl||v.minFilter===Is)&&qe("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(R,n.TEXTURE_WRAP_S,Xe[v.wrapS]),n.texParameteri(R,n.TEXTURE_WRAP_T,Xe[v.wrapT]),(R===n.TEXTURE_3D||R===n.TEXTURE_2D_ARRAY)&&n.texParameteri(R,n.TEXTURE_WRAP_R,Xe[v.wrapR]),n.texParameteri(R,n.TEXTURE_MAG_FILTER,ot[v.magFilter]),n.texParameteri(R,n.TEXTURE_MIN_FILTER,ot[v.minFilter]),v.compareFunction&&(n.texParameteri(R,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(R,n.TEXTURE_COMPARE_FUNC,Ve[v.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(v.magFilter===Ln||v.minFilter!==fl&&v.minFilter!==Is||v.type===Ai&&e.has("OES_texture_float_linear")===!1)return;if(v.anisotropy>1||i.get(v).__currentAnisotropy){let X=e.get("EXT_texture_filter_anisotropic");n.texParameterf(R,X.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(v.anisotropy,s.getMaxAnisotropy())),i.get(v).__currentAnisotropy=v.anisotropy}}}function ct(R,v){let X=!1;R.__webglInit===void 0&&(R.__webglInit=!0,v.addEventListener("dispose",P),F(v));let ue=v.source,oe=d.get(ue);oe===void 0&&(oe={},d.set(ue,oe));let _e=ee(v);if(_e!==R.__cacheKey){oe[_e]===void 0&&(oe[_e]={texture:n.createTexture(),usedTimes:0},o.memory.textures++,X=!0),oe[_e].usedTimes++;let xe=oe[R.__cacheKey];xe!==void 0&&(oe[R.__cacheKey].usedTimes--,xe.usedTimes===0&&z(v)),R.__cacheKey=_e,R.__webglTexture=oe[_e].texture}return X}function it(R,v,X){return Math.floor(Math.floor(R/X)/v)}function Kt(R,v,X,ue){let _e=R.updateRanges;if(_e.length===0)t.texSubImage2D(n.TEXTURE_2D,0,0,0,v.width,v.height,X,ue,v.data);else{_e.sort((U,re)=>U.start-re.start);let xe=0;for(let U=1;U<_e.length;U++){let re=_e[xe],ie=_e[U],Ee=re.start+re.count,ge=it(ie.start,v.width,4),be=it(re.start,v.width,4);ie.start<=Ee+1&&ge===be&&it(ie.start+ie.count-1,v.width,4)===ge?re.count=Math.max(re.count,ie.start+ie.count-re.start):(++xe,_e[xe]=ie)}_e.length=xe+1;let ne=t.getParameter(n.UNPACK_ROW_LENGTH),se=t.getParameter(n.UNPACK_SKIP_PIXELS),pe=t.getParameter(n.UNPACK_SKIP_ROWS);t.pixelStorei(n.UNPACK_ROW_LENGTH,v.width);for(let U=0,re=_e.length;U<re;U++){let ie=_e[U],Ee=Math.floor(ie.start/4),ge=Math.ceil(ie.count/4),be=Ee%v.width,He=Math.floor(Ee/v.width),Je=ge,ce=1;t.pixelStorei(n.UNPACK_SKIP_PIXELS,be),t.pixelStorei(n.UNPACK_SKIP_ROWS,He),t.texSubImage2D(n.TEXTURE_2D,0,be,He,Je,ce,X,ue,v.data)}R.clearUpdateRanges(),t.pixelStorei(n.UNPACK_ROW_LENGTH,ne),t.pixelStorei(n.UNPACK_SKIP_PIXELS,se),t.pixelStorei(n.UNPACK_SKIP_ROWS,pe)}}function Gt(R,v,X){let ue=n.TEXTURE_2D;(v.isDataArrayTexture||v.isCompressedArrayTexture)&&(ue=n.TEXTURE_2D_ARRAY),v.isData3DTexture&&(ue=n.TEXTURE_3D);let oe=ct(R,v),_e=v.source;t.bindTexture(ue,R.__webglTexture,n.TEXTURE0+X);let xe=i.get(_e);if(_e.version!==xe.__version||oe===!0){if(t.activeTexture(n.TEXTURE0+X),(typeof ImageBitmap<"u"&&v.image instanceof ImageBitmap)===!1){let ce=xt.getPrimaries(xt.workingColorSpace),Be=v.colorSpace===Ps?null:xt.getPrimaries(v.colorSpace),je=v.colorSpace===Ps||ce===Be?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,v.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,je)}t.pixelStorei(n.UNPACK_ALIGNMENT,v.unpackAlignment);let se=b(v.image,!1,s.maxTextureSize);se=ze(v,se);let pe=r.convert(v.format,v.colorSpace),U=r.convert(v.type),re=A(v.internalFormat,pe,U,v.normalized,v.colorSpace,v.isVideoTexture);ft(ue,v);let ie,Ee=v.mipmaps,ge=v.isVideoTexture!==!0,be=xe.__version===void 0||oe===!0,He=_e.dataReady,Je=T(v,se);if(v.isDepthTexture)re=_(v.format===Cs,v.type),be&&(ge?t.texStorage2D(n.TEXTURE_2D,1,re,se.width,se.height):t.texImage2D(n.TEXTURE_2D,0,re,se.width,se.height,0,pe,U,null));else if(v.isDataTexture)if(Ee.length>0){ge&&be&&t.texStorage2D(n.TEXTURE_2D,Je,re,Ee[0].width,Ee[0].height);for(let ce=0,Be=Ee.length;ce<Be;ce++)ie=Ee[ce],ge?He&&t.texSubImage2D(n.TEXTURE_2D,ce,0,0,ie.width,ie.height,pe,U,ie.data):t.texImage2D(n.TEXTURE_2D,ce,re,ie.width,ie.height,0,pe,U,ie.data);v.generateMipmaps=!1}else ge?(be&&t.texStorage2D(n.TEXTURE_2D,Je,re,se.width,se.height),He&&Kt(v,se,pe,U)):t.texImage2D(n.TEXTURE_2D,0,re,se.width,se.height,0,pe,U,se.data);else if(v.isCompressedTexture)if(v.isCompressedArrayTexture){ge&&be&&t.texStorage3D(n.TEXTURE_2D_ARRAY,Je,re,Ee[0].width,Ee[0].height,se.depth);for(let ce=0,Be=Ee.length;ce<Be;ce++)if(ie=Ee[ce],v.format!==Hi)if(pe!==null)if(ge){if(He)if(v.layerUpdates.size>0){let je=rp(ie.width,ie.height,v.format,v.type);for(let Re of v.layerUpdates){let lt=ie.data.subarray(Re*je/ie.data.BYTES_PER_ELEMENT,(Re+1)*je/ie.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ce,0,0,Re,ie.width,ie.height,1,pe,lt)}}else t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ce,0,0,0,ie.width,ie.height,se.depth,pe,ie.data)}else t.compressedTexImage3D(n.TEXTURE_2D_ARRAY,ce,re,ie.width,ie.height,se.depth,0,ie.data,0,0);else qe("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ge?He&&t.texSubImage3D(n.TEXTURE_2D_ARRAY,ce,0,0,0,ie.width,ie.height,se.depth,pe,U,ie.data):t.texImage3D(n.TEXTURE_2D_ARRAY,ce,re,ie.width,ie.height,se.depth,0,pe,U,ie.data);v.layerUpdates.size>0&&v.clearLayerUpdates()}else{ge&&be&&t.texStorage2D(n.TEXTURE_2D,Je,re,Ee[0].width,Ee[0].height);for(let ce=0,Be=Ee.length;ce<Be;ce++)ie=Ee[ce],v.format!==Hi?pe!==null?ge?He&&t.compressedTexSubImage2D(n.TEXTURE_2D,ce,0,0,ie.width,ie.height,pe,ie.data):t.compressedTexImage2D(n.TEXTURE_2D,ce,re,ie.width,ie.height,0,ie.data):qe("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ge?He&&t.texSubImage2D(n.TEXTURE_2D,ce,0,0,ie.width,ie.height,pe,U,ie.data):t.texImage2D(n.TEXTURE_2D,ce,re,ie.width,ie.height,0,pe,U,ie.data)}else if(v.isDataArrayTexture)if(ge){if(be&&t.texStorage3D(n.TEXTURE_2D_ARRAY,Je,re,se.width,se.height,se.depth),He)if(v.layerUpdates.size>0){let ce=rp(se.width,se.height,v.format,v.type);for(let Be of v.layerUpdates){let je=se.data.subarray(Be*ce/se.data.BYTES_PER_ELEMENT,(Be+1)*ce/se.data.BYTES_PER_ELEMENT);t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,Be,se.width,se.height,1,pe,U,je)}v.clearLayerUpdates()}else t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,se.width,se.height,se.depth,pe,U,se.data)}else t.texImage3D(n.TEXTURE_2D_ARRAY,0,re,se.width,se.height,se.depth,0,pe,U,se.data);else if(v.isData3DTexture)ge?(be&&t.texStorage3D(n.TEXTURE_3D,Je,re,se.width,se.height,se.depth),He&&t.texSubImage3D(n.TEXTURE_3D,0,0,0,0,se.width,se.height,se.depth,pe,U,se.data)):t.texImage3D(n.TEXTURE_3D,0,re,se.width,se.height,se.depth,0,pe,U,se.data);else if(v.isFramebufferTexture){if(be)if(ge)t.texStorage2D(n.TEXTURE_2D,Je,re,se.width,se.height);else{let ce=se.width,Be=se.height;for(let je=0;je<Je;je++)t.texImage2D(n.TEXTURE_2D,je,re,ce,Be,0,pe,U,null),ce>>=1,Be>>=1}}else if(v.isHTMLTexture){if("texElementImage2D"in n){let ce=n.canvas;if(ce.hasAttribute("layoutsubtree")||ce.setAttribute("layoutsubtree","true"),se.parentNode!==ce){ce.appendChild(se),h.add(v),ce.onpaint=Be=>{let je=Be.changedElements;for(let Re of h)je.includes(Re.image)&&(Re.needsUpdate=!0)},ce.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,se);else{let je=n.RGBA,Re=n.RGBA,lt=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,je,Re,lt,se)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(Ee.length>0){if(ge&&be){let ce=Ke(Ee[0]);t.texStorage2D(n.TEXTURE_2D,Je,re,ce.width,ce.height)}for(let ce=0,Be=Ee.length;ce<Be;ce++)ie=Ee[ce],ge?He&&t.texSubImage2D(n.TEXTURE_2D,ce,0,0,pe,U,ie):t.texImage2D(n.TEXTURE_2D,ce,re,pe,U,ie);v.generateMipmaps=!1}else if(ge){if(be){let ce=Ke(se);t.texStorage2D(n.TEXTURE_2D,Je,re,ce.width,ce.height)}He&&t.texSubImage2D(n.TEXTURE_2D,0,0,0,pe,U,se)}else t.texImage2D(n.TEXTURE_2D,0,re,pe,U,se);I(v)&&v.mipmapsAutoUpdate===!0&&x(ue),xe.__version=_e.version,v.onUpdate&&v.onUpdate(v)}R.__version=v.version}function on(R,v,X){if(v.image.length!==6)return;let ue=ct(R,v),oe=v.source;t.bindTexture(n.TEXTURE_CUBE_MAP,R.__webglTexture,n.TEXTURE0+X);let _e=i.get(oe);if(oe.version!==_e.__version||ue===!0){t.activeTexture(n.TEXTURE0+X);let xe=xt.getPrimaries(xt.workingColorSpace),ne=v.colorSpace===Ps?null:xt.getPrimaries(v.colorSpace),se=v.colorSpace===Ps||xe===ne?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,v.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),t.pixelStorei(n.UNPACK_ALIGNMENT,v.unpackAlignment),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,se);let pe=v.isCompressedTexture||v.image[0].isCompressedTexture,U=v.image[0]&&v.image[0].isDataTexture,re=[];for(let Re=0;Re<6;Re++)!pe&&!U?re[Re]=b(v.image[Re],!0,s.maxCubemapSize):re[Re]=U?v.image[Re].image:v.image[Re],re[Re]=ze(v,re[Re]);let ie=re[0],Ee=r.convert(v.format,v.colorSpace),ge=r.convert(v.type),be=A(v.internalFormat,Ee,ge,v.normalized,v.colorSpace),He=v.isVideoTexture!==!0,Je=_e.__version===void 0||ue===!0,ce=oe.dataReady,Be=T(v,ie);ft(n.TEXTURE_CUBE_MAP,v);let je;if(v.isDepthTexture){if(be=_(v.format===Cs,v.type),Je)if(He)t.texStorage2D(n.TEXTURE_CUBE_MAP,1,be,ie.width,ie.height);else for(let Re=0;Re<6;Re++)t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,ie.width,ie.height,0,Ee,ge,null)}else if(pe){He&&Je&&t.texStorage2D(n.TEXTURE_CUBE_MAP,Be,be,ie.width,ie.height);for(let Re=0;Re<6;Re++){je=re[Re].mipmaps;for(let lt=0;lt<je.length;lt++){let zt=je[lt];v.format!==Hi?Ee!==null?He?ce&&t.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,lt,0,0,zt.width,zt.height,Ee,zt.data):t.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,lt,be,zt.width,zt.height,0,zt.data):qe("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):He?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,lt,0,0,zt.width,zt.height,Ee,ge,zt.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,lt,be,zt.width,zt.height,0,Ee,ge,zt.data)}}}else{if(je=v.mipmaps,He&&Je){je.length>0&&Be++;let Re=Ke(re[0]);t.texStorage2D(n.TEXTURE_CUBE_MAP,Be,be,Re.width,Re.height)}for(let Re=0;Re<6;Re++)if(U){He?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,re[Re].width,re[Re].height,Ee,ge,re[Re].data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,re[Re].width,re[Re].height,0,Ee,ge,re[Re].data);for(let lt=0;lt<je.length;lt++){let Vn=je[lt].image[Re].image;He?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,lt+1,0,0,Vn.width,Vn.height,Ee,ge,Vn.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,lt+1,be,Vn.width,Vn.height,0,Ee,ge,Vn.data)}}else{He?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,Ee,ge,re[Re]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,Ee,ge,re[Re]);for(let lt=0;lt<je.length;lt++){let zt=je[lt];He?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,lt+1,0,0,Ee,ge,zt.image[Re]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,lt+1,be,Ee,ge,zt.image[Re])}}}I(v)&&v.mipmapsAutoUpdate===!0&&x(n.TEXTURE_CUBE_MAP),_e.__version=oe.version,v.onUpdate&&v.onUpdate(v)}R.__version=v.version}function Dt(R,v,X,ue,oe,_e){let xe=r.convert(X.format,X.colorSpace),ne=r.convert(X.type),se=A(X.internalFormat,xe,ne,X.normalized,X.colorSpace),pe=i.get(v),U=i.get(X);if(U.__renderTarget=v,!pe.__hasExternalTextures){let re=Math.max(1,v.width>>_e),ie=Math.max(1,v.height>>_e);oe===n.TEXTURE_3D||oe===n.TEXTURE_2D_ARRAY?t.texImage3D(oe,_e,se,re,ie,v.depth,0,xe,ne,null):t.texImage2D(oe,_e,se,re,ie,0,xe,ne,null)}t.bindFramebuffer(n.FRAMEBUFFER,R),Me(v)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ue,oe,U.__webglTexture,0,at(v)):(oe===n.TEXTURE_2D||oe>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&oe<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,ue,oe,U.__webglTexture,_e),t.bindFramebuffer(n.FRAMEBUFFER,null)}function wn(R,v,X){if(n.bindRenderbuffer(n.RENDERBUFFER,R),v.depthBuffer){let ue=v.depthTexture,oe=ue&&ue.isDepthTexture?ue.type:null,_e=_(v.stencilBuffer,oe),xe=v.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;Me(v)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,at(v),_e,v.width,v.height):X?n.renderbufferStorageMultisample(n.RENDERBUFFER,at(v),_e,v.width,v.height):n.renderbufferStorage(n.RENDERBUFFER,_e,v.width,v.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,xe,n.RENDERBUFFER,R)}else{let ue=v.textures;for(let oe=0;oe<ue.length;oe++){let _e=ue[oe],xe=r.convert(_e.format,_e.colorSpace),ne=r.convert(_e.type),se=A(_e.internalFormat,xe,ne,_e.normalized,_e.colorSpace);Me(v)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,at(v),se,v.width,v.height):X?n.renderbufferStorageMultisample(n.RENDERBUFFER,at(v),se,v.width,v.height):n.renderbufferStorage(n.RENDERBUFFER,se,v.width,v.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function vt(R,v,X){let ue=v.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(n.FRAMEBUFFER,R),!(v.depthTexture&&v.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let oe=i.get(v.depthTexture);oe.__renderTarget=v;let _e=ue?v.depthTexture.image[0]:v.depthTexture.image;(!oe.__webglTexture||_e.width!==v.width||_e.height!==v.height)&&(_e.width=v.width,_e.height=v.height,v.depthTexture.needsUpdate=!0),ue?Se(v.depthTexture,0):me(v.depthTexture,0);let xe=oe.__webglTexture,ne=at(v),se=ue?n.TEXTURE_CUBE_MAP_POSITIVE_X+X:n.TEXTURE_2D,pe=v.depthTexture.format===Cs?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(v.depthTexture.format===ws)Me(v)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,pe,se,xe,0,ne):n.framebufferTexture2D(n.FRAMEBUFFER,pe,se,xe,0);else if(v.depthTexture.format===Cs)Me(v)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,pe,se,xe,0,ne):n.framebufferTexture2D(n.FRAMEBUFFER,pe,se,xe,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function gn(R){let v=i.get(R),X=R.isWebGLCubeRenderTarget===!0;if(v.__boundDepthTexture!==R.depthTexture){let ue=R.depthTexture;if(v.__depthDisposeCallback&&v.__depthDisposeCallback(),ue){let oe=()=>{delete v.__boundDepthTexture,delete v.__depthDisposeCallback,ue.removeEventListener("dispose",oe)};ue.addEventListener("dispose",oe),v.__depthDisposeCallback=oe}v.__boundDepthTexture=ue}if(R.depthTexture&&!v.__autoAllocateDepthBuffer)if(X)for(let ue=0;ue<6;ue++)vt(v.__webglFramebuffer[ue],R,ue);else R.texture.mipmaps.length>0?vt(v.__webglFramebuffer[0],R,0):vt(v.__webglFramebuffer,R,0);else if(X){v.__webglDepthbuffer=[];for(let ue=0;ue<6;ue++)if(t.bindFramebuffer(n.FRAMEBUFFER,v.__webglFramebuffer[ue]),v.__webglDepthbuffer[ue]===void 0)v.__webglDepthbuffer[ue]=n.createRenderbuffer(),wn(v.__webglDepthbuffer[ue],R,!1);else{let oe=R.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,_e=v.__webglDepthbuffer[ue];n.bindRenderbuffer(n.RENDERBUFFER,_e),n.framebufferRenderbuffer(n.FRAMEBUFFER,oe,n.RENDERBUFFER,_e)}}else if(R.texture.mipmaps.length>0?t.bindFramebuffer(n.FRAMEBUFFER,v.__webglFramebuffer[0]):t.bindFramebuffer(n.FRAMEBUFFER,v.__webglFramebuffer),v.__webglDepthbuffer===void 0)v.__webglDepthbuffer=n.createRenderbuffer(),wn(v.__webglDepthbuffer,R,!1);else{let oe=R.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,_e=v.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,_e),n.framebufferRenderbuffer(n.FRAMEBUFFER,oe,n.RENDERBUFFER,_e)}t.bindFramebuffer(n.FRAMEBUFFER,null)}function jt(R,v,X){let ue=i.get(R);v!==void 0&&Dt(ue.__webglFramebuffer,R,R.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),X!==void 0&&gn(R)}function an(R){let v=R.texture,X=i.get(R),ue=i.get(v);R.addEventListener("dispose",B),F(R);let oe=R.textures,_e=R.isWebGLCubeRenderTarget===!0,xe=oe.length>1;if(xe||(ue.__webglTexture===void 0&&(ue.__webglTexture=n.createTexture()),ue.__version=v.version,o.memory.textures++),_e){X.__webglFramebuffer=[];for(let ne=0;ne<6;ne++)if(v.mipmaps.length>0){X.__webglFramebuffer[ne]=[];for(let se=0;se<v.mipmaps.length;se++)X.__webglFramebuffer[ne][se]=n.createFramebuffer()}else X.__webglFramebuffer[ne]=n.createFramebuffer()}else{if(v.mipmaps.length>0){X.__webglFramebuffer=[];for(let ne=0;ne<v.mipmaps.length;ne++)X.__webglFramebuffer[ne]=n.createFramebuffer()}else X.__webglFramebuffer=n.createFramebuffer();if(xe)for(let ne=0,se=oe.length;ne<se;ne++){let pe=i.get(oe[ne]);pe.__webglTexture===void 0&&(pe.__webglTexture=n.createTexture(),o.memory.textures++)}if(R.samples>0&&Me(R)===!1){X.__webglMultisampledFramebuffer=n.createFramebuffer(),X.__webglColorRenderbuffer=[],t.bindFramebuffer(n.FRAMEBUFFER,X.__webglMultisampledFramebuffer);for(let ne=0;ne<oe.length;ne++){let se=oe[ne];X.__webglColorRenderbuffer[ne]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,X.__webglColorRenderbuffer[ne]);let pe=r.convert(se.format,se.colorSpace),U=r.convert(se.type),re=A(se.internalFormat,pe,U,se.normalized,se.colorSpace,R.isXRRenderTarget===!0),ie=at(R);n.renderbufferStorageMultisample(n.RENDERBUFFER,ie,re,R.width,R.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ne,n.RENDERBUFFER,X.__webglColorRenderbuffer[ne])}n.bindRenderbuffer(n.RENDERBUFFER,null),R.depthBuffer&&(X.__webglDepthRenderbuffer=n.createRenderbuffer(),wn(X.__webglDepthRenderbuffer,R,!0)),t.bindFramebuffer(n.FRAMEBUFFER,null)}}if(_e){t.bindTexture(n.TEXTURE_CUBE_MAP,ue.__webglTexture),ft(n.TEXTURE_CUBE_MAP,v);for(let ne=0;ne<6;ne++)if(v.mipmaps.length>0)for(let se=0;se<v.mipmaps.length;se++)Dt(X.__webglFramebuffer[ne][se],R,v,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+ne,se);else Dt(X.__webglFramebuffer[ne],R,v,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+ne,0);I(v)?x(n.TEXTURE_CUBE_MAP):v.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),t.unbindTexture()}else if(xe){for(let ne=0,se=oe.length;ne<se;ne++){let pe=oe[ne],U=i.get(pe),re=n.TEXTURE_2D;(R.isWebGL3DRenderTarget||R.isWebGLArrayRenderTarget)&&(re=R.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(re,U.__webglTexture),ft(re,pe),Dt(X.__webglFramebuffer,R,pe,n.COLOR_ATTACHMENT0+ne,re,0),I(pe)&&x(re)}t.unbindTexture()}else{let ne=n.TEXTURE_2D;if((R.isWebGL3DRenderTarget||R.isWebGLArrayRenderTarget)&&(ne=R.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(ne,ue.__webglTexture),ft(ne,v),v.mipmaps.length>0)for(let se=0;se<v.mipmaps.length;se++)Dt(X.__webglFramebuffer[se],R,v,n.COLOR_ATTACHMENT0,ne,se);else Dt(X.__webglFramebuffer,R,v,n.COLOR_ATTACHMENT0,ne,0);I(v)?x(ne):v.mipmaps.length>0&&n.texParameteri(ne,n.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),t.unbindTexture()}R.depthBuffer&&gn(R)}function O(R){let v=R.textures;for(let X=0,ue=v.length;X<ue;X++){let oe=v[X];if(I(oe)&&oe.mipmapsAutoUpdate===!0){let _e=w(R),xe=i.get(oe).__webglTexture;t.bindTexture(_e,xe),x(_e),t.unbindTexture()}}}let Ie=[];function Ze(R){if(R.samples>0){if(Me(R)===!1){let v=R.textures,X=R.width,ue=R.height,oe=n.COLOR_BUFFER_BIT,_e=R.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,xe=i.get(R),ne=v.length>1;if(ne)for(let pe=0;pe<v.length;pe++)t.bindFramebuffer(n.FRAMEBUFFER,xe.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+pe,n.RENDERBUFFER,null),t.bindFramebuffer(n.FRAMEBUFFER,xe.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+pe,n.TEXTURE_2D,null,0);t.bindFramebuffer(n.READ_FRAMEBUFFER,xe.__webglMultisampledFramebuffer),R.texture.mipmaps.length>0?t.bindFramebuffer(n.DRAW_FRAMEBUFFER,xe.__webglFramebuffer[0]):t.bindFramebuffer(n.DRAW_FRAMEBUFFER,xe.__webglFramebuffer);for(let pe=0;pe<v.length;pe++){if(R.resolveDepthBuffer&&(R.depthBuffer&&(oe|=n.DEPTH_BUFFER_BIT),R.stencilBuffer&&R.resolveStencilBuffer&&(oe|=n.STENCIL_BUFFER_BIT)),ne){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,xe.__webglColorRenderbuffer[pe]);let U=i.get(v[pe]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,U,0)}n.blitFramebuffer(0,0,X,ue,0,0,X,ue,oe,n.NEAREST),c===!0&&(Ie.length=0,Ie.push(n.COLOR_ATTACHMENT0+pe),R.depthBuffer&&R.storeMultisampledDepthBuffer===!1&&Ie.push(_e),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,Ie))}if(t.bindFramebuffer(n.READ_FRAMEBUFFER,null),t.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),ne)for(let pe=0;pe<v.length;pe++){t.bindFramebuffer(n.FRAMEBUFFER,xe.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+pe,n.RENDERBUFFER,xe.__webglColorRenderbuffer[pe]);let U=i.get(v[pe]).__webglTexture;t.bindFramebuffer(n.FRAMEBUFFER,xe.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+pe,n.TEXTURE_2D,U,0)}t.bindFramebuffer(n.DRAW_FRAMEBUFFER,xe.__webglMultisampledFramebuffer)}else if(R.depthBuffer&&R.storeMultisampledDepthBuffer===!1&&c){let v=R.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[v])}}}function at(R){return Math.min(s.maxSamples,R.samples)}function Me(R){let v=i.get(R);return R.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&v.__useRenderToTexture!==!1}function Ot(R){let v=o.render.frame;u.get(R)!==v&&(u.set(R,v),R.update())}function ze(R,v){let X=R.colorSpace,ue=R.format,oe=R.type;return R.isCompressedTexture===!0||R.isVideoTexture===!0||X!==Ha&&X!==Ps&&(xt.getTransfer(X)===It?(ue!==Hi||oe!==ti)&&qe("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Qe("WebGLTextures: Unsupported texture color space:",X)),v}function Ke(R){return typeof HTMLImageElement<"u"&&R instanceof HTMLImageElement?(l.width=R.naturalWidth||R.width,l.height=R.naturalHeight||R.height):typeof VideoFrame<"u"&&R instanceof VideoFrame?(l.width=R.displayWidth,l.height=R.displayHeight):(l.width=R.width,l.height=R.height),l}this.allocateTextureUnit=he,this.resetTextureUnits=j,this.getTextureUnits=te,this.setTextureUnits=fe,this.setTexture2D=me,this.setTexture2DArray=ye,this.setTexture3D=we,this.setTextureCube=Se,this.rebindTextures=jt,this.setupRenderTarget=an,this.updateRenderTargetMipmap=O,this.updateMultisampleRenderTarget=Ze,this.setupDepthRenderbuffer=gn,this.setupFrameBufferTexture=Dt,this.useMultisampledRTT=Me,this.dispose=V}function lR(n,e){function t(i,s=Ps){let r,o=xt.getTransfer(s);if(i===ti)return n.UNSIGNED_BYTE;if(i===xu)return n.UNSIGNED_SHORT_4_4_4_4;if(i===vu)return n.UNSIGNED_SHORT_5_5_5_1;if(i===Hd)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===Wd)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===zd)return n.BYTE;if(i===Vd)return n.SHORT;if(i===Zo)return n.UNSIGNED_SHORT;if(i===yu)return n.INT;if(i===zi)return n.UNSIGNED_INT;if(i===Ai)return n.FLOAT;if(i===Vi)return n.HALF_FLOAT;if(i===Xd)return n.ALPHA;if(i===Yd)return n.RGB;if(i===Hi)return n.RGBA;if(i===ws)return n.DEPTH_COMPONENT;if(i===Cs)return n.DEPTH_STENCIL;if(i===bu)return n.RED;if(i===Su)return n.RED_INTEGER;if(i===or)return n.RG;if(i===Mu)return n.RG_INTEGER;if(i===Eu)return n.RGBA_INTEGER;if(i===dl||i===pl||i===ml||i===gl)if(o===It)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===dl)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===pl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===ml)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===gl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===dl)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===pl)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===ml)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===gl)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===Tu||i===Au||i===wu||i===Ru)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===Tu)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===Au)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===wu)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===Ru)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===Iu||i===Cu||i===Pu||i===Nu||i===Lu||i===_l||i===Du)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(i===Iu||i===Cu)return o===It?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===Pu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===Nu)return r.COMPRESSED_R11_EAC;if(i===Lu)return r.COMPRESSED_SIGNED_R11_EAC;if(i===_l)return r.COMPRESSED_RG11_EAC;if(i===Du)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===Uu||i===Ou||i===Fu||i===Bu||i===ku||i===Gu||i===zu||i===Vu||i===Hu||i===Wu||i===Xu||i===Yu||i===Ku||i===Zu)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(i===Uu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===Ou)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===Fu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Bu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===ku)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===Gu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===zu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Vu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Hu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Wu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===Xu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===Yu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===Ku)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Zu)return o===It?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===qu||i===$u||i===Ju)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(i===qu)return o===It?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===$u)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===Ju)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===ju||i===Qu||i===yl||i===eh)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(i===ju)return r.COMPRESSED_RED_RGTC1_EXT;if(i===Qu)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===yl)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===eh)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Dr?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:t}}var cR=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,uR=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,pp=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let i=new tl(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=i}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,i=new rs({vertexShader:cR,fragmentShader:uR,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new Ct(new wr(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},mp=class extends Gi{constructor(e,t){super();let i=this,s=null,r=1,o=null,a="local-floor",c=1,l=null,u=null,h=null,f=null,d=null,p=null,S=typeof XRWebGLBinding<"u",g=new pp,m={},b=t.getContextAttributes(),I=null,x=null,w=[],A=[],_=new We,T=null,F=null,D=new Gn;D.viewport=new qt;let P=new Gn;P.viewport=new qt;let B=[D,P],G=new du,N=null,V=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(ee){let me=w[ee];return me===void 0&&(me=new Oo,w[ee]=me),me.getTargetRaySpace()},this.getControllerGrip=function(ee){let me=w[ee];return me===void 0&&(me=new Oo,w[ee]=me),me.getGripSpace()},this.getHand=function(ee){let me=w[ee];return me===void 0&&(me=new Oo,w[ee]=me),me.getHandSpace()};function Y(ee){let me=A.indexOf(ee.inputSource);if(me===-1)return;let ye=w[me];ye!==void 0&&(ye.update(ee.inputSource,ee.frame,l||o),ye.dispatchEvent({type:ee.type,data:ee.inputSource}))}function z(){s.removeEventListener("select",Y),s.removeEventListener("selectstart",Y),s.removeEventListener("selectend",Y),s.removeEventListener("squeeze",Y),s.removeEventListener("squeezestart",Y),s.removeEventListener("squeezeend",Y),s.removeEventListener("end",z),s.removeEventListener("inputsourceschange",le);for(let ee=0;ee<w.length;ee++){let me=A[ee];me!==null&&(A[ee]=null,w[ee].disconnect(me))}N=null,V=null,g.reset();for(let ee in m)delete m[ee];if(e.setRenderTarget(I),d=null,f=null,h=null,s=null,x=null,he.stop(),i.isPresenting=!1,e.setPixelRatio(T),e.setSize(_.width,_.height,!1),F!==null){let ee=F.camera;ee.fov=F.fov,ee.zoom=F.zoom,ee.updateProjectionMatrix(),F=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(ee){r=ee,i.isPresenting===!0&&qe("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(ee){a=ee,i.isPresenting===!0&&qe("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return l||o},this.setReferenceSpace=function(ee){l=ee},this.getBaseLayer=function(){return f!==null?f:d},this.getBinding=function(){return h===null&&S&&(h=new XRWebGLBinding(s,t)),h},this.getFrame=function(){return p},this.getSession=function(){return s},this.setSession=async function(ee){if(s=ee,s!==null){if(I=e.getRenderTarget(),s.addEventListener("select",Y),s.addEventListener("selectstart",Y),s.addEventListener("selectend",Y),s.addEventListener("squeeze",Y),s.addEventListener("squeezestart",Y),s.addEventListener("squeezeend",Y),s.addEventListener("end",z),s.addEventListener("inputsourceschange",le),b.xrCompatible!==!0&&await t.makeXRCompatible(),T=e.getPixelRatio(),e.getSize(_),S&&"createProjectionLayer"in XRWebGLBinding.prototype){let ye=null,we=null,Se=null;b.depth&&(Se=b.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ye=b.stencil?Cs:ws,we=b.stencil?Dr:zi);let Xe={colorFormat:t.RGBA8,depthFormat:Se,scaleFactor:r};h=this.getBinding(),f=h.createProjectionLayer(Xe),s.updateRenderState({layers:[f]}),e.setPixelRatio(1),e.setSize(f.textureWidth,f.textureHeight,!1),x=new di(f.textureWidth,f.textureHeight,{format:Hi,type:ti,depthTexture:new Rs(f.textureWidth,f.textureHeight,we,void 0,void 0,void 0,void 0,void 0,void 0,ye),stencilBuffer:b.stencil,colorSpace:e.outputColorSpace,samples:b.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}else{let ye={antialias:b.antialias,alpha:!0,depth:b.depth,stencil:b.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,t,ye),s.updateRenderState({baseLayer:d}),e.setPixelRatio(1),e.setSize(d.framebufferWidth,d.framebufferHeight,!1),x=new di(d.framebufferWidth,d.framebufferHeight,{format:Hi,type:ti,colorSpace:e.outputColorSpace,stencilBuffer:b.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}x.isXRRenderTarget=!0,this.setFoveation(c),l=null,o=await s.requestReferenceSpace(a),he.setContext(s),he.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return g.getDepthTexture()};function le(ee){for(let me=0;me<ee.removed.length;me++){let ye=ee.removed[me],we=A.indexOf(ye);we>=0&&(A[we]=null,w[we].disconnect(ye))}for(let me=0;me<ee.added.length;me++){let ye=ee.added[me],we=A.indexOf(ye);if(we===-1){for(let Xe=0;Xe<w.length;Xe++)if(Xe>=A.length){A.push(ye),we=Xe;break}else if(A[Xe]===null){A[Xe]=ye,we=Xe;break}if(we===-1)break}let Se=w[we];Se&&Se.connect(ye)}}function q(ee,me){me===null?ee.matrixWorld.copy(ee.matrix):ee.matrixWorld.multiplyMatrices(me.matrixWorld,ee.matrix),ee.matrixWorldInverse.copy(ee.matrixWorld).invert()}this.updateCamera=function(ee){if(s===null)return;let me=ee.near,ye=ee.far;g.texture!==null&&(g.depthNear>0&&(me=g.depthNear),g.depthFar>0&&(ye=g.depthFar)),G.near=P.near=D.near=me,G.far=P.far=D.far=ye,(N!==G.near||V!==G.far)&&(s.updateRenderState({depthNear:G.near,depthFar:G.far}),N=G.near,V=G.far),G.layers.mask=ee.layers.mask|6,D.layers.mask=G.layers.mask&-5,P.layers.mask=G.layers.mask&-3;let we=ee.parent,Se=G.cameras;q(G,we);for(let Xe=0;Xe<Se.length;Xe++)q(Se[Xe],we);G.projectionMatrix.copy(D.projectionMatrix),G.projectionMatrixInverse.copy(D.projectionMatrixInverse),F===null&&ee.isPerspectiveCamera&&(F={camera:ee,fov:ee.fov,zoom:ee.zoom}),j(ee,G,we)};function j(ee,me,ye){ye===null?ee.matrix.copy(me.matrixWorld):(ee.matrix.copy(ye.matrixWorld),ee.matrix.invert(),ee.matrix.multiply(me.matrixWorld)),ee.matrix.decompose(ee.position,ee.quaternion,ee.scale),ee.updateMatrixWorld(!0),ee.projectionMatrix.copy(me.projectionMatrix),ee.projectionMatrixInverse.copy(me.projectionMatrixInverse),ee.isPerspectiveCamera&&(ee.fov=Do*2*Math.atan(1/ee.projectionMatrix.elements[5]),ee.zoom=1)}this.getCamera=function(){return G},this.getFoveation=function(){if(!(f===null&&d===null))return c},this.setFoveation=function(ee){c=ee,f!==null&&(f.fixedFoveation=ee),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=ee)},this.hasDepthSensing=function(){return g.texture!==null},this.getDepthSensingMesh=function(){return g.getMesh(G)},this.getCameraTexture=function(ee){return m[ee]};let te=null;function fe(ee,me){if(u=me.getViewerPose(l||o),p=me,u!==null){let ye=u.views;d!==null&&(e.setRenderTargetFramebuffer(x,d.framebuffer),e.setRenderTarget(x));let we=!1;ye.length!==G.cameras.length&&(G.cameras.length=0,we=!0);for(let Ve=0;Ve<ye.length;Ve++){let ft=ye[Ve],ct=null;if(d!==null)ct=d.getViewport(ft);else{let Kt=h.getViewSubImage(f,ft);ct=Kt.viewport,Ve===0&&(e.setRenderTargetTextures(x,Kt.colorTexture,Kt.depthStencilTexture),e.setRenderTarget(x))}let it=B[Ve];it===void 0&&(it=new Gn,it.layers.enable(Ve),it.viewport=new qt,B[Ve]=it),it.matrix.fromArray(ft.transform.matrix),it.matrix.decompose(it.position,it.quaternion,it.scale),it.projectionMatrix.fromArray(ft.projectionMatrix),it.projectionMatrixInverse.copy(it.projectionMatrix).invert(),it.viewport.set(ct.x,ct.y,ct.width,ct.height),Ve===0&&(G.matrix.copy(it.matrix),G.matrix.decompose(G.position,G.quaternion,G.scale)),we===!0&&G.cameras.push(it)}let Se=s.enabledFeatures;if(Se&&Se.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&S){h=i.getBinding();let Ve=h.getDepthInformation(ye[0]);Ve&&Ve.isValid&&Ve.texture&&g.init(Ve,s.renderState)}if(Se&&Se.includes("camera-access")&&S){e.state.unbindTexture(),h=i.getBinding();for(let Ve=0;Ve<ye.length;Ve++){let ft=ye[Ve].camera;if(ft){let ct=m[ft];ct||(ct=new tl,m[ft]=ct);let it=h.getCameraImage(ft);ct.sourceTexture=it}}}}for(let ye=0;ye<w.length;ye++){let we=A[ye],Se=w[ye];we!==null&&Se!==void 0&&Se.update(we,me,l||o)}te&&te(ee,me),me.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:me}),p=null}let he=new ky;he.setAnimationLoop(fe),this.setAnimationLoop=function(ee){te=ee},this.dispose=function(){}}},hR=new Tt,qy=new nt;qy.set(-1,0,0,0,1,0,0,0,1);function fR(n,e){function t(g,m){g.matrixAutoUpdate===!0&&g.updateMatrix(),m.value.copy(g.matrix)}function i(g,m){m.color.getRGB(g.fogColor.value,np(n)),m.isFog?(g.fogNear.value=m.near,g.fogFar.value=m.far):m.isFogExp2&&(g.fogDensity.value=m.density)}function s(g,m,b,I,x){m.isNodeMaterial?m.uniformsNeedUpdate=!1:m.isMeshBasicMaterial?r(g,m):m.isMeshLambertMaterial?(r(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshToonMaterial?(r(g,m),h(g,m)):m.isMeshPhongMaterial?(r(g,m),u(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshStandardMaterial?(r(g,m),f(g,m),m.isMeshPhysicalMaterial&&d(g,m,x)):m.isMeshMatcapMaterial?(r(g,m),p(g,m)):m.isMeshDepthMaterial?r(g,m):m.isMeshDistanceMaterial?(r(g,m),S(g,m)):m.isMeshNormalMaterial?r(g,m):m.isLineBasicMaterial?(o(g,m),m.isLineDashedMaterial&&a(g,m)):m.isPointsMaterial?c(g,m,b,I):m.isSpriteMaterial?l(g,m):m.isShadowMaterial?(g.color.value.copy(m.color),g.opacity.value=m.opacity):m.isShaderMaterial&&(m.uniformsNeedUpdate=!1)}function r(g,m){g.opacity.value=m.opacity,m.color&&g.diffuse.value.copy(m.color),m.emissive&&g.emissive.value.copy(m.emissive).multiplyScalar(m.emissiveIntensity),m.map&&(g.map.value=m.map,t(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.bumpMap&&(g.bumpMap.value=m.bumpMap,t(m.bumpMap,g.bumpMapTransform),g.bumpScale.value=m.bumpScale,m.side===Mn&&(g.bumpScale.value*=-1)),m.normalMap&&(g.normalMap.value=m.normalMap,t(m.normalMap,g.normalMapTransform),g.normalScale.value.copy(m.normalScale),m.side===Mn&&g.normalScale.value.negate()),m.displacementMap&&(g.displacementMap.value=m.displacementMap,t(m.displacementMap,g.displacementMapTransform),g.displacementScale.value=m.displacementScale,g.displacementBias.value=m.displacementBias),m.emissiveMap&&(g.emissiveMap.value=m.emissiveMap,t(m.emissiveMap,g.emissiveMapTransform)),m.specularMap&&(g.specularMap.value=m.specularMap,t(m.specularMap,g.specularMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest);let b=e.get(m),I=b.envMap,x=b.envMapRotation;I&&(g.envMap.value=I,g.envMapRotation.value.setFromMatrix4(hR.makeRotationFromEuler(x)).transpose(),I.isCubeTexture&&I.isRenderTargetTexture===!1&&g.envMapRotation.value.premultiply(qy),g.reflectivity.value=m.reflectivity,g.ior.value=m.ior,g.refractionRatio.value=m.refractionRatio),m.lightMap&&(g.lightMap.value=m.lightMap,g.lightMapIntensity.value=m.lightMapIntensity,t(m.lightMap,g.lightMapTransform)),m.aoMap&&(g.aoMap.value=m.aoMap,g.aoMapIntensity.value=m.aoMapIntensity,t(m.aoMap,g.aoMapTransform))}function o(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,m.map&&(g.map.value=m.map,t(m.map,g.mapTransform))}function a(g,m){g.dashSize.value=m.dashSize,g.totalSize.value=m.dashSize+m.gapSize,g.scale.value=m.scale}function c(g,m,b,I){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.size.value=m.size*b,g.scale.value=I*.5,m.map&&(g.map.value=m.map,t(m.map,g.uvTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function l(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.rotation.value=m.rotation,m.map&&(g.map.value=m.map,t(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function u(g,m){g.specular.value.copy(m.specular),g.shininess.value=Math.max(m.shininess,1e-4)}function h(g,m){m.gradientMap&&(g.gradientMap.value=m.gradientMap)}function f(g,m){g.metalness.value=m.metalness,m.metalnessMap&&(g.metalnessMap.value=m.metalnessMap,t(m.metalnessMap,g.metalnessMapTransform)),g.roughness.value=m.roughness,m.roughnessMap&&(g.roughnessMap.value=m.roughnessMap,t(m.roughnessMap,g.roughnessMapTransform)),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)}function d(g,m,b){g.ior.value=m.ior,m.diffuseRoughness>0&&(g.diffuseRoughness.value=m.diffuseRoughness,m.diffuseRoughnessMap&&(g.diffuseRoughnessMap.value=m.diffuseRoughnessMap,t(m.diffuseRoughnessMap,g.diffuseRoughnessMapTransform))),m.sheen>0&&(g.sheenColor.value.copy(m.sheenColor).multiplyScalar(m.sheen),g.sheenRoughness.value=m.sheenRoughness,m.sheenColorMap&&(g.sheenColorMap.value=m.sheenColorMap,t(m.sheenColorMap,g.sheenColorMapTransform)),m.sheenRoughnessMap&&(g.sheenRoughnessMap.value=m.sheenRoughnessMap,t(m.sheenRoughnessMap,g.sheenRoughnessMapTransform))),m.clearcoat>0&&(g.clearcoat.value=m.clearcoat,g.clearcoatRoughness.value=m.clearcoatRoughness,m.clearcoatMap&&(g.clearcoatMap.value=m.clearcoatMap,t(m.clearcoatMap,g.clearcoatMapTransform)),m.clearcoatRoughnessMap&&(g.clearcoatRoughnessMap.value=m.clearcoatRoughnessMap,t(m.clearcoatRoughnessMap,g.clearcoatRoughnessMapTransform)),m.clearcoatNormalMap&&(g.clearcoatNormalMap.value=m.clearcoatNormalMap,t(m.clearcoatNormalMap,g.clearcoatNormalMapTransform),g.clearcoatNormalScale.value.copy(m.clearcoatNormalScale),m.side===Mn&&g.clearcoatNormalScale.value.negate())),m.dispersion>0&&(g.dispersion.value=m.dispersion),m.retroreflectivity>0&&(g.retroreflectivity.value=m.retroreflectivity),m.iridescence>0&&(g.iridescence.value=m.iridescence,g.iridescenceIOR.value=m.iridescenceIOR,g.iridescenceThicknessMinimum.value=m.iridescenceThicknessMinimum,g.iridescenceThicknessMaximum.value=m.iridescenceThicknessMaximum,m.iridescenceMap&&(g.iridescenceMap.value=m.iridescenceMap,t(m.iridescenceMap,g.iridescenceMapTransform)),m.iridescenceThicknessMap&&(g.iridescenceThicknessMap.value=m.iridescenceThicknessMap,t(m.iridescenceThicknessMap,g.iridescenceThicknessMapTransform))),m.transmission>0&&(g.transmission.value=m.transmission,g.transmissionSamplerMap.value=b.texture,g.transmissionSamplerSize.value.set(b.width,b.height),m.transmissionMap&&(g.transmissionMap.value=m.transmissionMap,t(m.transmissionMap,g.transmissionMapTransform)),g.thickness.value=m.thickness,m.thicknessMap&&(g.thicknessMap.value=m.thicknessMap,t(m.thicknessMap,g.thicknessMapTransform)),g.attenuationDistance.value=m.attenuationDistance,g.attenuationColor.value.copy(m.attenuationColor)),m.anisotropy>0&&(g.anisotropyVector.value.set(m.anisotropy*Math.cos(m.anisotropyRotation),m.anisotropy*Math.sin(m.anisotropyRotation)),m.anisotropyMap&&(g.anisotropyMap.value=m.anisotropyMap,t(m.anisotropyMap,g.anisotropyMapTransform))),g.specularIntensity.value=m.specularIntensity,g.specularColor.value.copy(m.specularColor),m.specularColorMap&&(g.specularColorMap.value=m.specularColorMap,t(m.specularColorMap,g.specularColorMapTransform)),m.specularIntensityMap&&(g.specularIntensityMap.value=m.specularIntensityMap,t(m.specularIntensityMap,g.specularIntensityMapTransform))}function p(g,m){m.matcap&&(g.matcap.value=m.matcap)}function S(g,m){let b=e.get(m).light;g.referencePosition.value.setFromMatrixPosition(b.matrixWorld),g.nearDistance.value=b.shadow.camera.near,g.farDistance.value=b.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function dR(n,e,t,i){let s={},r={};function o(b,I){let x=I.program;i.uniformBlockBinding(b,x,s[b.id])}function a(b,I){let x=s[b.id];x===void 0&&(p(b),x=c(b),s[b.id]=x,b.addEventListener("dispose",g));let w=I.program;i.updateUBOMapping(b,w);let A=e.render.frame;r[b.id]!==A&&(l(b),r[b.id]=A)}function c(b){let I=n.createBuffer(),x=b.__size,w=b.usage;return n.bindBuffer(n.UNIFORM_BUFFER,I),n.bufferData(n.UNIFORM_BUFFER,x,w),n.bindBuffer(n.UNIFORM_BUFFER,null),I}function l(b){let I=s[b.id],x=b.uniforms,w=b.__cache;n.bindBuffer(n.UNIFORM_BUFFER,I);for(let A=0,_=x.length;A<_;A++){let T=x[A];if(Array.isArray(T))for(let F=0,D=T.length;F<D;F++)u(T[F],A,F,w);else u(T,A,0,w)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function u(b,I,x,w){if(f(b,I,x,w)===!0){let A=b.__offset,_=b.value;if(Array.isArray(_)){let T=0;for(let F=0;F<_.length;F++){let D=_[F],P=S(D,!0);h(D,b.__data,T),T+=P.storage/Float32Array.BYTES_PER_ELEMENT}}else h(_,b.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,A,b.__data)}}function h(b,I,x){typeof b=="number"||typeof b=="boolean"?I[x]=b:b.isMatrix3?(I[x]=b.elements[0],I[x+1]=b.elements[1],I[x+2]=b.elements[2],I[x+3]=0,I[x+4]=b.elements[3],I[x+5]=b.elements[4],I[x+6]=b.elements[5],I[x+7]=0,I[x+8]=b.elements[6],I[x+9]=b.elements[7],I[x+10]=b.elements[8],I[x+11]=0):ArrayBuffer.isView(b)?I.set(b.subarray(0,I.length-x),x):b.toArray(I,x)}function f(b,I,x,w){let A=b.value,_=I+"_"+x;if(Array.isArray(A)){w[_]===void 0&&(w[_]=[]);let T=w[_],F=!1;for(let D=0;D<A.length;D++)d(A[D],T,D)===!0&&(F=!0);return F}return d(A,w,_)}function d(b,I,x){if(I[x]===void 0)return typeof b=="number"||typeof b=="boolean"?I[x]=b:ArrayBuffer.isView(b)?I[x]=b.slice():I[x]=b.clone(),!0;{let w=I[x];if(typeof b=="number"||typeof b=="boolean"){if(w!==b)return I[x]=b,!0}else{if(ArrayBuffer.isView(b))return!0;if(w.equals(b)===!1)return w.copy(b),!0}}return!1}function p(b){let I=b.uniforms,x=0,w=16;for(let _=0,T=I.length;_<T;_++){let F=Array.isArray(I[_])?I[_]:[I[_]];for(let D=0,P=F.length;D<P;D++){let B=F[D],G=Array.isArray(B.value)?B.value:[B.value],N=Array.isArray(I[_])||Array.isArray(B.value),V=x;for(let z=0,le=G.length;z<le;z++){let q=G[z],j=S(q,N),te=x%w,fe=te%j.boundary,he=te+fe;x+=fe,he!==0&&w-he<j.storage&&(x+=w-he),z===0&&(V=x),x+=j.storage}let Y=B.type==="int"?Int32Array:B.type==="uint"?Uint32Array:Float32Array;B.__data=new Y((x-V)/Float32Array.BYTES_PER_ELEMENT),B.__offset=V}}let A=x%w;return A>0&&(x+=w-A),b.__size=x,b.__cache={},this}function S(b,I){let x={boundary:0,storage:0};return typeof b=="number"||typeof b=="boolean"?(x.boundary=4,x.storage=4):b.isVector2?(x.boundary=8,x.storage=8):b.isVector3||b.isColor?(x.boundary=16,x.storage=12):b.isVector4?(x.boundary=16,x.storage=16):b.isMatrix3?(x.boundary=16,x.storage=48):b.isMatrix4?(x.boundary=16,x.storage=64):b.isTexture?qe("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(b)?(x.boundary=16,x.storage=b.byteLength):qe("WebGLRenderer: Unsupported uniform value type.",b),I===!0&&(x.boundary=16,x.storage=Math.ceil(x.storage/16)*16),x}function g(b){let I=b.target;I.removeEventListener("dispose",g),n.deleteBuffer(s[I.id]),delete s[I.id],delete r[I.id]}function m(){for(let b in s)n.deleteBuffer(s[b]);s={},r={}}return{bind:o,update:a,dispose:m}}var pR=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),ls=null;function mR(){return ls===null&&(ls=new Ar(pR,16,16,or,Vi),ls.name="DFG_LUT",ls.minFilter=Jn,ls.magFilter=Jn,ls.wrapS=ns,ls.wrapT=ns,ls.generateMipmaps=!1,ls.needsUpdate=!0),ls}var rh=class{constructor(e={}){let{canvas:t=cy(),context:i=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:c=!0,preserveDrawingBuffer:l=!1,powerPreference:u="default",failIfMajorPerformanceCaveat:h=!1,reversedDepthBuffer:f=!1,outputBufferType:d=ti}=e;this.isWebGLRenderer=!0;let p;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=i.getContextAttributes().alpha}else p=o;let S=d,g=new Set([Eu,Mu,Su]),m=new Set([ti,zi,Zo,Dr,xu,vu]),b=new Uint32Array(4),I=new Int32Array(4),x={textures:[],min:[],max:[],resolution:[]},w=null,A=null,_=[],T=[],F=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=as,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let D=this,P=!1,B=null,G=null,N=null,V=null;this._outputColorSpace=qn;let Y=0,z=0,le=null,q=-1,j=null,te=new qt,fe=new qt,he=null,ee=new rt(0),me=0,ye=t.width,we=t.height,Se=1,Xe=null,ot=null,Ve=new qt(0,0,ye,we),ft=new qt(0,0,ye,we),ct=!1,it=new js,Kt=new Qc,Gt=!1,on=!1,Dt=new Tt,wn=new W,vt=new qt,gn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},jt=!1;function an(){return le===null?Se:1}let O=i;function Ie(E,k){return t.getContext(E,k)}let Ze,at,Me,Ot,ze,Ke,R,v,X,ue,oe,_e,xe,ne,se,pe,U,re,ie,Ee,ge,be,He;try{let E={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:c,preserveDrawingBuffer:l,powerPreference:u,failIfMajorPerformanceCaveat:h};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",Be,!1),t.addEventListener("webglcontextrestored",je,!1),t.addEventListener("webglcontextcreationerror",Re,!1),O===null){let k="webgl2";if(O=Ie(k,E),O===null)throw Ie(k)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Je()}catch(E){throw t.removeEventListener("webglcontextlost",Be,!1),t.removeEventListener("webglcontextrestored",je,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),Qe("WebGLRenderer: "+E.message),E}function Je(){Ze=new A1(O),Ze.init(),ge=new lR(O,Ze),at=new m1(O,Ze,e,ge),Me=new oR(O,Ze),at.reversedDepthBuffer&&f&&Me.buffers.depth.setReversed(!0),G=O.createFramebuffer(),N=O.createFramebuffer(),V=O.createFramebuffer(),Ot=new I1(O),ze=new Yw,Ke=new aR(O,Ze,Me,ze,at,ge,Ot),R=new T1(D),v=new PE(O),be=new d1(O,v),X=new w1(O,v,Ot,be),ue=new P1(O,X,v,be,Ot),re=new C1(O,at,Ke),se=new g1(ze),oe=new Xw(D,R,Ze,at,be,se),_e=new fR(D,ze),xe=new Zw,ne=new eR(Ze),U=new f1(D,R,Me,ue,p,c),pe=new rR(D,ue,at),He=new dR(O,Ot,at,Me),ie=new p1(O,Ze,Ot),Ee=new R1(O,Ze,Ot),Ot.programs=oe.programs,D.capabilities=at,D.extensions=Ze,D.properties=ze,D.renderLists=xe,D.shadowMap=pe,D.state=Me,D.info=Ot}S!==ti&&(F=new L1(S,t.width,t.height,a,s,r));let ce=new mp(D,O);this.xr=ce,this.getContext=function(){return O},this.getContextAttributes=function(){return O.getContextAttributes()},this.forceContextLoss=function(){let E=Ze.get("WEBGL_lose_context");E&&E.loseContext()},this.forceContextRestore=function(){let E=Ze.get("WEBGL_lose_context");E&&E.restoreContext()},this.getPixelRatio=function(){return Se},this.setPixelRatio=function(E){E!==void 0&&(Se=E,this.setSize(ye,we,!1))},this.getSize=function(E){return E.set(ye,we)},this.setSize=function(E,k,Q=!0){if(ce.isPresenting){qe("WebGLRenderer: Can't change size while VR device is presenting.");return}ye=E,we=k,t.width=Math.floor(E*Se),t.height=Math.floor(k*Se),Q===!0&&(t.style.width=E+"px",t.style.height=k+"px"),F!==null&&F.setSize(t.width,t.height),this.setViewport(0,0,E,k)},this.getDrawingBufferSize=function(E){return E.set(ye*Se,we*Se).floor()},this.setDrawingBufferSize=function(E,k,Q){ye=E,we=k,Se=Q,t.width=Math.floor(E*Q),t.height=Math.floor(k*Q),this.setViewport(0,0,E,k)},this.setEffects=function(E){if(S===ti){Qe("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(E){for(let k=0;k<E.length;k++)if(E[k].isOutputPass===!0){qe("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}F.setEffects(E||[])},this.getCurrentViewport=function(E){return E.copy(te)},this.getViewport=function(E){return E.copy(Ve)},this.setViewport=function(E,k,Q,Z){E.isVector4?Ve.set(E.x,E.y,E.z,E.w):Ve.set(E,k,Q,Z),Me.viewport(te.copy(Ve).multiplyScalar(an()).round())},this.getScissor=function(E){return E.copy(ft)},this.setScissor=function(E,k,Q,Z){E.isVector4?ft.set(E.x,E.y,E.z,E.w):ft.set(E,k,Q,Z),Me.scissor(fe.copy(ft).multiplyScalar(an()).round())},this.getScissorTest=function(){return ct},this.setScissorTest=function(E){Me.setScissorTest(ct=E)},this.setOpaqueSort=function(E){Xe=E},this.setTransparentSort=function(E){ot=E},this.getClearColor=function(E){return E.copy(U.getClearColor())},this.setClearColor=function(){U.setClearColor(...arguments)},this.getClearAlpha=function(){return U.getClearAlpha()},this.setClearAlpha=function(){U.setClearAlpha(...arguments)},this.clear=function(E=!0,k=!0,Q=!0){let Z=0;if(E){let $=!1;if(le!==null){let Te=le.texture.format;$=g.has(Te)}if($){let Te=le.texture.type,Ce=m.has(Te),Ae=U.getClearColor(),Pe=U.getClearAlpha(),Ge=Ae.r,et=Ae.g,dt=Ae.b;Ce?(b[0]=Ge,b[1]=et,b[2]=dt,b[3]=Pe,O.clearBufferuiv(O.COLOR,0,b)):(I[0]=Ge,I[1]=et,I[2]=dt,I[3]=Pe,O.clearBufferiv(O.COLOR,0,I))}else Z|=O.COLOR_BUFFER_BIT}k&&(Z|=O.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),Q&&(Z|=O.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),Z!==0&&O.clear(Z)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(E){E.setRenderer(this),B=E},this.dispose=function(){t.removeEventListener("webglcontextlost",Be,!1),t.removeEventListener("webglcontextrestored",je,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),U.dispose(),xe.dispose(),ne.dispose(),Ke.dispose(),ze.dispose(),R.dispose(),ue.dispose(),X.dispose(),be.dispose(),He.dispose(),oe.dispose(),ce.dispose(),ce.removeEventListener("sessionstart",Il),ce.removeEventListener("sessionend",Xi),us.stop()};function Be(E){E.preventDefault(),Ya("WebGLRenderer: Context Lost."),P=!0}function je(){Ya("WebGLRenderer: Context Restored."),P=!1;let E=Ot.autoReset,k=pe.enabled,Q=pe.autoUpdate,Z=pe.needsUpdate,$=pe.type;Je(),Ot.autoReset=E,pe.enabled=k,pe.autoUpdate=Q,pe.needsUpdate=Z,pe.type=$}function Re(E){Qe("WebGLRenderer: A WebGL context could not be created. Reason: ",E.statusMessage)}function lt(E){let k=E.target;k.removeEventListener("dispose",lt),zt(k)}function zt(E){Vn(E),ze.remove(E)}function Vn(E){let k=ze.get(E).programs;k!==void 0&&(k.forEach(function(Q){oe.releaseProgram(Q)}),E.isShaderMaterial&&oe.releaseShaderCache(E))}this.renderBufferDirect=function(E,k,Q,Z,$,Te){k===null&&(k=gn);let Ce=$.isMesh&&$.matrixWorld.determinantAffine()<0,Ae=sa(E,k,Q,Z,$);Me.setMaterial(Z,Ce);let Pe=Q.index,Ge=1;if(Z.wireframe===!0){if(Pe=X.getWireframeAttribute(Q),Pe===void 0)return;Ge=2}let et=Q.drawRange,dt=Q.attributes.position,ke=et.start*Ge,pt=(et.start+et.count)*Ge;Te!==null&&(ke=Math.max(ke,Te.start*Ge),pt=Math.min(pt,(Te.start+Te.count)*Ge)),Pe!==null?(ke=Math.max(ke,0),pt=Math.min(pt,Pe.count)):dt!=null&&(ke=Math.max(ke,0),pt=Math.min(pt,dt.count));let $t=pt-ke;if($t<0||$t===1/0)return;be.setup($,Z,Ae,Q,Pe);let Pt,Nt=ie;if(Pe!==null&&(Pt=v.get(Pe),Nt=Ee,Nt.setIndex(Pt)),$.isMesh)Z.wireframe===!0?(Me.setLineWidth(Z.wireframeLinewidth*an()),Nt.setMode(O.LINES)):Nt.setMode(O.TRIANGLES);else if($.isLine){let _n=Z.linewidth;_n===void 0&&(_n=1),Me.setLineWidth(_n*an()),$.isLineSegments?Nt.setMode(O.LINES):$.isLineLoop?Nt.setMode(O.LINE_LOOP):Nt.setMode(O.LINE_STRIP)}else $.isPoints?Nt.setMode(O.POINTS):$.isSprite&&Nt.setMode(O.TRIANGLES);if($.isBatchedMesh)if(Ze.get("WEBGL_multi_draw"))Nt.renderMultiDraw($._multiDrawStarts,$._multiDrawCounts,$._multiDrawCount);else{let _n=$._multiDrawStarts,Oe=$._multiDrawCounts,ln=$._multiDrawCount,_t=Pe?v.get(Pe).bytesPerElement:1,fs=ze.get(Z).currentProgram.getUniforms();for(let cn=0;cn<ln;cn++)fs.setValue(O,"_gl_DrawID",cn),Nt.render(_n[cn]/_t,Oe[cn])}else if($.isInstancedMesh)Nt.renderInstances(ke,$t,$.count);else if(Q.isInstancedBufferGeometry){let _n=Q._maxInstanceCount!==void 0?Q._maxInstanceCount:1/0,Oe=Math.min(Q.instanceCount,_n);Nt.renderInstances(ke,$t,Oe)}else Nt.render(ke,$t)};function ta(E,k,Q,Z){B!==null&&E.isNodeMaterial&&B.setObject(Z,E),Gt===!0&&se.setState(E,Q,!1),E.transparent===!0&&E.side===os&&E.forceSinglePass===!1?(E.side=Mn,E.needsUpdate=!0,Yi(E,k,Z),E.side=rr,E.needsUpdate=!0,Yi(E,k,Z),E.side=os):Yi(E,k,Z)}this.compile=function(E,k,Q=null){Q===null&&(Q=E),B!==null&&B.renderStart(E,k,Q),A=ne.get(Q),A.init(k),T.push(A),Q.traverseVisible(function($){$.isLight&&$.layers.test(k.layers)&&(A.pushLight($),$.castShadow&&A.pushShadow($))}),E!==Q&&E.traverseVisible(function($){$.isLight&&$.layers.test(k.layers)&&(A.pushLight($),$.castShadow&&A.pushShadow($))}),A.setupLights(),B!==null&&B.updateLights(A.state.lightsArray),on=this.localClippingEnabled,Gt=se.init(this.clippingPlanes,on),Gt===!0&&se.setGlobalState(this.clippingPlanes,k),B!==null&&pe.render(A.state.shadowsArray,Q,k);let Z=new Set;return E.traverse(function($){if(!($.isMesh||$.isPoints||$.isLine||$.isSprite))return;let Te=$.material;if(Te)if(Array.isArray(Te))for(let Ce=0;Ce<Te.length;Ce++){let Ae=Te[Ce];ta(Ae,Q,k,$),Z.add(Ae)}else ta(Te,Q,k,$),Z.add(Te)}),A=T.pop(),B!==null&&B.renderEnd(),Z},this.compileAsync=function(E,k,Q=null){let Z=this.compile(E,k,Q);return new Promise($=>{function Te(){if(Z.forEach(function(Ce){let Pe=ze.get(Ce).currentProgram;(Pe===void 0||Pe.isReady())&&Z.delete(Ce)}),Z.size===0){$(E);return}setTimeout(Te,10)}Ze.get("KHR_parallel_shader_compile")!==null?Te():setTimeout(Te,10)})};let Fr=null;function Th(E){Fr&&Fr(E)}function Il(){us.stop()}function Xi(){us.start()}let us=new ky;us.setAnimationLoop(Th),typeof self<"u"&&us.setContext(self),this.setAnimationLoop=function(E){Fr=E,ce.setAnimationLoop(E),E===null?us.stop():us.start()},ce.addEventListener("sessionstart",Il),ce.addEventListener("sessionend",Xi),this.render=function(E,k){if(k!==void 0&&k.isCamera!==!0){Qe("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(P===!0)return;B!==null&&B.renderStart(E,k);let Q=ce.enabled===!0&&ce.isPresenting===!0,Z=F!==null&&(le===null||Q)&&F.begin(D,le);if(E.matrixWorldAutoUpdate===!0&&E.updateMatrixWorld(),k.parent===null&&k.matrixWorldAutoUpdate===!0&&k.updateMatrixWorld(),ce.enabled===!0&&ce.isPresenting===!0&&(F===null||F.isCompositing()===!1)&&(ce.cameraAutoUpdate===!0&&ce.updateCamera(k),k=ce.getCamera()),E.isScene===!0&&E.onBeforeRender(D,E,k,le),A=ne.get(E,T.length),A.init(k),A.state.textureUnits=Ke.getTextureUnits(),T.push(A),Dt.multiplyMatrices(k.projectionMatrix,k.matrixWorldInverse),k.isArrayCamera?Kt.setFromArrayCamera(k):it.setFromProjectionMatrix(Dt,Ei,k.reversedDepth),on=this.localClippingEnabled,Gt=se.init(this.clippingPlanes,on),w=xe.get(E,_.length),w.init(),_.push(w),this.info.render.frame++,ce.enabled===!0&&ce.isPresenting===!0){let Ce=D.xr.getDepthSensingMesh();Ce!==null&&hs(Ce,k,-1/0,D.sortObjects)}hs(E,k,0,D.sortObjects),w.finish(),B!==null&&B.updateLights(A.state.lightsArray),D.sortObjects===!0&&w.sort(Xe,ot),jt=ce.enabled===!1||ce.isPresenting===!1||ce.hasDepthSensing()===!1,jt&&U.addToRenderList(w,E),this.info.autoReset===!0&&this.info.reset(),Gt===!0&&se.beginShadows();let $=A.state.shadowsArray;if(pe.render($,E,k),Gt===!0&&se.endShadows(),(Z&&F.hasRenderPass())===!1){let Ce=w.opaque,Ae=w.transmissive;if(A.setupLights(),k.isArrayCamera){let Pe=k.cameras;if(Ae.length>0)for(let Ge=0,et=Pe.length;Ge<et;Ge++){let dt=Pe[Ge];Ri(Ce,Ae,E,dt)}jt&&U.render(E);for(let Ge=0,et=Pe.length;Ge<et;Ge++){let dt=Pe[Ge];na(w,E,dt,dt.viewport)}}else Ae.length>0&&Ri(Ce,Ae,E,k),jt&&U.render(E),na(w,E,k)}le!==null&&z===0&&(Ke.updateMultisampleRenderTarget(le),Ke.updateRenderTargetMipmap(le)),Z&&F.end(D),E.isScene===!0&&E.onAfterRender(D,E,k),be.resetDefaultState(),q=-1,j=null,T.pop(),T.length>0?(A=T[T.length-1],Ke.setTextureUnits(A.state.textureUnits),Gt===!0&&se.setGlobalState(D.clippingPlanes,A.state.camera)):A=null,_.pop(),_.length>0?w=_[_.length-1]:w=null,B!==null&&B.renderEnd()};function hs(E,k,Q,Z){if(E.visible===!1)return;if(E.layers.test(k.layers)){if(E.isGroup)Q=E.renderOrder;else if(E.isLOD)E.autoUpdate===!0&&E.update(k);else if(E.isLight)A.pushLight(E),E.castShadow&&A.pushShadow(E);else if(E.isSprite){let Ce=k.isArrayCamera?Kt:it;if(!E.frustumCulled||E.intersectsFrustum(Ce)){Z&&vt.setFromMatrixPosition(E.matrixWorld).applyMatrix4(Dt);let Ae=ue.update(E),Pe=E.material;Pe.visible&&w.push(E,Ae,Pe,Q,vt.z,null,k)}}else if(E.isMesh||E.isLine||E.isPoints){let Ce=k.isArrayCamera?Kt:it;if(!E.frustumCulled||E.intersectsFrustum(Ce)){let Ae=ue.update(E),Pe=E.material;if(Z&&(E.boundingSphere!==void 0?(E.boundingSphere===null&&E.computeBoundingSphere(),vt.copy(E.boundingSphere.center)):(Ae.boundingSphere===null&&Ae.computeBoundingSphere(),vt.copy(Ae.boundingSphere.center)),vt.applyMatrix4(E.matrixWorld).applyMatrix4(Dt)),Array.isArray(Pe)){let Ge=Ae.groups;for(let et=0,dt=Ge.length;et<dt;et++){let ke=Ge[et],pt=Pe[ke.materialIndex];pt&&pt.visible&&w.push(E,Ae,pt,Q,vt.z,ke,k)}}else Pe.visible&&w.push(E,Ae,Pe,Q,vt.z,null,k)}}}let Te=E.children;for(let Ce=0,Ae=Te.length;Ce<Ae;Ce++)hs(Te[Ce],k,Q,Z)}function na(E,k,Q,Z){let{opaque:$,transmissive:Te,transparent:Ce}=E;A.setupLightsView(Q),Gt===!0&&se.setGlobalState(D.clippingPlanes,Q),Z&&Me.viewport(te.copy(Z)),$.length>0&&Qt($,k,Q),Te.length>0&&Qt(Te,k,Q),Ce.length>0&&Qt(Ce,k,Q),Me.buffers.depth.setTest(!0),Me.buffers.depth.setMask(!0),Me.buffers.color.setMask(!0),Me.setPolygonOffset(!1)}function Ri(E,k,Q,Z){if((Q.isScene===!0?Q.overrideMaterial:null)!==null)return;if(A.state.transmissionRenderTarget[Z.id]===void 0){let ke=Ze.has("EXT_color_buffer_half_float")||Ze.has("EXT_color_buffer_float");A.state.transmissionRenderTarget[Z.id]=new di(1,1,{generateMipmaps:!0,type:ke?Vi:ti,minFilter:Is,samples:Math.max(4,at.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:xt.workingColorSpace})}let Te=A.state.transmissionRenderTarget[Z.id],Ce=Z.viewport||te;Te.setSize(Ce.z*D.transmissionResolutionScale,Ce.w*D.transmissionResolutionScale);let Ae=D.getRenderTarget(),Pe=D.getActiveCubeFace(),Ge=D.getActiveMipmapLevel();D.setRenderTarget(Te),D.getClearColor(ee),me=D.getClearAlpha(),me<1&&D.setClearColor(16777215,.5),D.clear(),jt&&U.render(Q);let et=D.toneMapping;D.toneMapping=as;let dt=Z.viewport;if(Z.viewport!==void 0&&(Z.viewport=void 0),A.setupLightsView(Z),Gt===!0&&se.setGlobalState(D.clippingPlanes,Z),Qt(E,Q,Z),Ke.updateMultisampleRenderTarget(Te),Ke.updateRenderTargetMipmap(Te),Ze.has("WEBGL_multisampled_render_to_texture")===!1){let ke=!1;for(let pt=0,$t=k.length;pt<$t;pt++){let Pt=k[pt],{object:Nt,geometry:_n,material:Oe,group:ln}=Pt;if(Oe.side===os&&Nt.layers.test(Z.layers)){let _t=Oe.side;Oe.side=Mn,Oe.needsUpdate=!0,sn(Nt,Q,Z,_n,Oe,ln),Oe.side=_t,Oe.needsUpdate=!0,ke=!0}}ke===!0&&(Ke.updateMultisampleRenderTarget(Te),Ke.updateRenderTargetMipmap(Te))}D.setRenderTarget(Ae,Pe,Ge),D.setClearColor(ee,me),dt!==void 0&&(Z.viewport=dt),D.toneMapping=et}function Qt(E,k,Q){let Z=k.isScene===!0?k.overrideMaterial:null;for(let $=0,Te=E.length;$<Te;$++){let Ce=E[$],{object:Ae,geometry:Pe,group:Ge}=Ce,et=Ce.material;et.allowOverride===!0&&Z!==null&&(et=Z),Ae.layers.test(Q.layers)&&sn(Ae,k,Q,Pe,et,Ge)}}function sn(E,k,Q,Z,$,Te){B!==null&&$.isNodeMaterial&&B.setObject(E,$),E.onBeforeRender(D,k,Q,Z,$,Te),E.modelViewMatrix.multiplyMatrices(Q.matrixWorldInverse,E.matrixWorld),E.normalMatrix.getNormalMatrix(E.modelViewMatrix),$.onBeforeRender(D,k,Q,Z,E,Te),$.transparent===!0&&$.side===os&&$.forceSinglePass===!1?($.side=Mn,$.needsUpdate=!0,D.renderBufferDirect(Q,k,Z,$,E,Te),$.side=rr,$.needsUpdate=!0,D.renderBufferDirect(Q,k,Z,$,E,Te),$.side=os):D.renderBufferDirect(Q,k,Z,$,E,Te),E.onAfterRender(D,k,Q,Z,$,Te)}function rn(E){let k=0;for(let Q of E)Q.texture!==null&&k++;return k}function Yi(E,k,Q){k.isScene!==!0&&(k=gn);let Z=ze.get(E),$=A.state.lights,Te=A.state.shadowsArray,Ce=$.state.version,Ae=oe.getParameters(E,$.state,Te,k,Q,A.state.lightProbeGridArray),Pe=oe.getProgramCacheKey(Ae),Ge=Z.programs;Z.environment=E.isMeshStandardMaterial||E.isMeshLambertMaterial||E.isMeshPhongMaterial?k.environment:null,Z.fog=k.fog;let et=E.isMeshStandardMaterial||E.isMeshLambertMaterial&&!E.envMap||E.isMeshPhongMaterial&&!E.envMap;Z.envMap=R.get(E.envMap||Z.environment,et),Z.envMapRotation=Z.environment!==null&&E.envMap===null?k.environmentRotation:E.envMapRotation,Ge===void 0&&(E.addEventListener("dispose",lt),Ge=new Map,Z.programs=Ge,Z.programVariants=new Map);let dt=Ge.get(Pe);if(dt!==void 0){if(Z.currentProgram===dt&&Z.lightsStateVersion===Ce)return ia(E,Ae),dt}else Ae.uniforms=oe.getUniforms(E),B!==null&&E.isNodeMaterial&&B.build(E,Q,Ae),E.onBeforeCompile(Ae,D),dt=oe.acquireProgram(Ae,Pe),Ge.set(Pe,dt),Z.uniforms=Ae.uniforms;let ke=Z.uniforms;return(!E.isShaderMaterial&&!E.isRawShaderMaterial||E.clipping===!0)&&(ke.clippingPlanes=se.uniform),ia(E,Ae),Z.needsLights=Ds(E),Z.lightsStateVersion=Ce,Z.needsLights&&(ke.ambientLightColor.value=$.state.ambient,ke.lightProbe.value=$.state.probe,ke.sunLights.value=$.state.sun,ke.sunLightShadows.value=$.state.sunShadow,ke.directionalLights.value=$.state.directional,ke.directionalLightShadows.value=$.state.directionalShadow,ke.spotLights.value=$.state.spot,ke.spotLightShadows.value=$.state.spotShadow,ke.rectAreaLights.value=$.state.rectArea,ke.ltc_1.value=$.state.rectAreaLTC1,ke.ltc_2.value=$.state.rectAreaLTC2,ke.pointLights.value=$.state.point,ke.pointLightShadows.value=$.state.pointShadow,ke.hemisphereLights.value=$.state.hemi,ke.sunShadowMatrix.value=$.state.sunShadowMatrix,ke.sunShadowCascade.value=$.state.sunShadowCascade,ke.directionalShadowMatrix.value=$.state.directionalShadowMatrix,ke.spotLightMatrix.value=$.state.spotLightMatrix,ke.spotLightMap.value=$.state.spotLightMap,ke.pointShadowMatrix.value=$.state.pointShadowMatrix),Z.numLightProbeGrids=rn(A.state.lightProbeGridArray),Z.currentProgram=dt,Z.uniformsList=null,dt}function ii(E,k,Q,Z,$){let Te=ze.get(E),Ce=Te.currentProgram.id+","+Z+","+$,Ae=Te.programVariants.get(Ce);return Ae===void 0?(Ae=Yi(E,k,Q),Te.programVariants.set(Ce,Ae)):(Te.currentProgram=Ae,Te.uniformsList=null,Te.outputColorSpace=Z,Te.toneMapping=$),Ae}function Ls(E){if(E.uniformsList===null){let k=E.currentProgram.getUniforms();E.uniformsList=qo.seqWithValue(k.seq,E.uniforms)}return E.uniformsList}function ia(E,k){let Q=ze.get(E);Q.outputColorSpace=k.outputColorSpace,Q.batching=k.batching,Q.batchingColor=k.batchingColor,Q.instancing=k.instancing,Q.instancingColor=k.instancingColor,Q.instancingMorph=k.instancingMorph,Q.skinning=k.skinning,Q.morphTargets=k.morphTargets,Q.morphNormals=k.morphNormals,Q.morphColors=k.morphColors,Q.morphTargetsCount=k.morphTargetsCount,Q.numClippingPlanes=k.numClippingPlanes,Q.numIntersection=k.numClipIntersection,Q.vertexAlphas=k.vertexAlphas,Q.vertexTangents=k.vertexTangents,Q.toneMapping=k.toneMapping}function sa(E,k,Q,Z,$){k.isScene!==!0&&(k=gn),Ke.resetTextureUnits();let Te=k.fog,Ce=Z.isMeshStandardMaterial||Z.isMeshLambertMaterial||Z.isMeshPhongMaterial?k.environment:null,Ae=le===null?D.outputColorSpace:le.isXRRenderTarget===!0?le.texture.colorSpace:xt.workingColorSpace,Pe=Z.isMeshStandardMaterial||Z.isMeshLambertMaterial&&!Z.envMap||Z.isMeshPhongMaterial&&!Z.envMap,Ge=R.get(Z.envMap||Ce,Pe),et=Z.vertexColors===!0&&!!Q.attributes.color&&Q.attributes.color.itemSize===4,dt=!!Q.attributes.tangent&&(!!Z.normalMap||Z.anisotropy>0),ke=!!Q.morphAttributes.position,pt=!!Q.morphAttributes.normal,$t=!!Q.morphAttributes.color,Pt=as;Z.toneMapped&&(le===null||le.isXRRenderTarget===!0)&&(Pt=D.toneMapping);let Nt=Q.morphAttributes.position||Q.morphAttributes.normal||Q.morphAttributes.color,_n=Nt!==void 0?Nt.length:0,Oe=ze.get(Z),ln=A.state.lights;if(Gt===!0&&(on===!0||E!==j)){let Lt=E===j&&Z.id===q;se.setState(Z,E,Lt)}let _t=!1,fs=!1;Z.version===Oe.__version?Oe.needsLights&&Oe.lightsStateVersion!==ln.state.version||$.isBatchedMesh&&Oe.batching===!1||!$.isBatchedMesh&&Oe.batching===!0||$.isBatchedMesh&&Oe.batchingColor===!0&&$._colorsTexture===null||$.isBatchedMesh&&Oe.batchingColor===!1&&$._colorsTexture!==null||$.isInstancedMesh&&Oe.instancing===!1||!$.isInstancedMesh&&Oe.instancing===!0||$.isSkinnedMesh&&Oe.skinning===!1||!$.isSkinnedMesh&&Oe.skinning===!0||$.isInstancedMesh&&Oe.instancingColor===!0&&$.instanceColor===null||$.isInstancedMesh&&Oe.instancingColor===!1&&$.instanceColor!==null||$.isInstancedMesh&&Oe.instancingMorph===!0&&$.morphTexture===null||$.isInstancedMesh&&Oe.instancingMorph===!1&&$.morphTexture!==null||Oe.envMap!==Ge||Z.fog===!0&&Oe.fog!==Te||Oe.numClippingPlanes!==void 0&&(Oe.numClippingPlanes!==se.numPlanes||Oe.numIntersection!==se.numIntersection)||Oe.vertexAlphas!==et||Oe.vertexTangents!==dt||Oe.morphTargets!==ke||Oe.morphNormals!==pt||Oe.morphColors!==$t||Oe.morphTargetsCount!==_n||Oe.numLightProbeGrids!==rn(A.state.lightProbeGridArray)?_t=!0:(Oe.outputColorSpace!==Ae||Oe.toneMapping!==Pt)&&(fs=!0):(_t=!0,Oe.__version=Z.version);let cn=Oe.currentProgram;(_t===!0||fs===!0)&&(cn=fs===!0?ii(Z,k,$,Ae,Pt):Yi(Z,k,$),B&&Z.isNodeMaterial&&B.onUpdateProgram(Z,cn,Oe));let Gr=!1,Ki=!1,ds=!1,ut=cn.getUniforms(),en=Oe.uniforms;if(Me.useProgram(cn.program)&&(Gr=!0,Ki=!0,ds=!0),Z.id!==q&&(q=Z.id,Ki=!0),Gr||j!==E){Me.buffers.depth.getReversed()&&E.reversedDepth!==!0&&(E._reversedDepth=!0,E.updateProjectionMatrix()),ut.setValue(O,"projectionMatrix",E.projectionMatrix),ut.setValue(O,"viewMatrix",E.matrixWorldInverse);let un=ut.map.cameraPosition;un!==void 0&&un.setValue(O,wn.setFromMatrixPosition(E.matrixWorld)),at.logarithmicDepthBuffer&&ut.setValue(O,"logDepthBufFC",2/(Math.log(E.far+1)/Math.LN2)),(Z.isMeshPhongMaterial||Z.isMeshToonMaterial||Z.isMeshLambertMaterial||Z.isMeshBasicMaterial||Z.isMeshStandardMaterial||Z.isShaderMaterial)&&ut.setValue(O,"isOrthographic",E.isOrthographicCamera===!0),j!==E&&(j=E,Ki=!0,ds=!0)}if(Oe.needsLights&&(ln.state.sunShadowMap.length>0&&ut.setValue(O,"sunShadowMap",ln.state.sunShadowMap,Ke),ln.state.directionalShadowMap.length>0&&ut.setValue(O,"directionalShadowMap",ln.state.directionalShadowMap,Ke),ln.state.spotShadowMap.length>0&&ut.setValue(O,"spotShadowMap",ln.state.spotShadowMap,Ke),ln.state.pointShadowMap.length>0&&ut.setValue(O,"pointShadowMap",ln.state.pointShadowMap,Ke)),$.isSkinnedMesh){ut.setOptional(O,$,"bindMatrix"),ut.setOptional(O,$,"bindMatrixInverse");let Lt=$.skeleton;Lt&&(Lt.boneTexture===null&&Lt.computeBoneTexture(),ut.setValue(O,"boneTexture",Lt.boneTexture,Ke))}$.isBatchedMesh&&(ut.setOptional(O,$,"batchingTexture"),ut.setValue(O,"batchingTexture",$._matricesTexture,Ke),ut.setOptional(O,$,"batchingIdTexture"),ut.setValue(O,"batchingIdTexture",$._indirectTexture,Ke),ut.setOptional(O,$,"batchingColorTexture"),$._colorsTexture!==null&&ut.setValue(O,"batchingColorTexture",$._colorsTexture,Ke));let Hn=Q.morphAttributes;if((Hn.position!==void 0||Hn.normal!==void 0||Hn.color!==void 0)&&re.update($,Q,cn),(Ki||Oe.receiveShadow!==$.receiveShadow)&&(Oe.receiveShadow=$.receiveShadow,ut.setValue(O,"receiveShadow",$.receiveShadow)),(Z.isMeshStandardMaterial||Z.isMeshLambertMaterial||Z.isMeshPhongMaterial)&&Z.envMap===null&&k.environment!==null&&(en.envMapIntensity.value=k.environmentIntensity),en.dfgLUT!==void 0&&(en.dfgLUT.value=mR()),Ki){if(ut.setValue(O,"toneMappingExposure",D.toneMappingExposure),Oe.needsLights&&Br(en,ds),Te&&Z.fog===!0&&_e.refreshFogUniforms(en,Te),_e.refreshMaterialUniforms(en,Z,Se,we,A.state.transmissionRenderTarget[E.id]),Oe.needsLights&&Oe.numLightProbeGrids>0){let Lt=x,un=0;for(let Fn of A.state.lightProbeGridArray)Fn.texture!==null&&(Lt.textures[un]=Fn.texture,Lt.min[un]=Fn.boundingBox.min,Lt.max[un]=Fn.boundingBox.max,Lt.resolution[un]=Fn.resolution,un++);for(let Fn in Lt)Lt[Fn].length=un;en.probesSH.value=Lt.textures,en.probesMin.value=Lt.min,en.probesMax.value=Lt.max,en.probesResolution.value=Lt.resolution}qo.upload(O,Ls(Oe),en,Ke)}if(Z.isShaderMaterial&&Z.uniformsNeedUpdate===!0&&(qo.upload(O,Ls(Oe),en,Ke),Z.uniformsNeedUpdate=!1),Z.isSpriteMaterial&&ut.setValue(O,"center",$.center),ut.setValue(O,"modelViewMatrix",$.modelViewMatrix),ut.setValue(O,"normalMatrix",$.normalMatrix),ut.setValue(O,"modelMatrix",$.matrixWorld),Z.uniformsGroups!==void 0){let Lt=Z.uniformsGroups;for(let un=0,Fn=Lt.length;un<Fn;un++){let Cl=Lt[un];He.update(Cl,cn),He.bind(Cl,cn)}}return cn}function Br(E,k){E.ambientLightColor.needsUpdate=k,E.lightProbe.needsUpdate=k,E.sunLights.needsUpdate=k,E.sunLightShadows.needsUpdate=k,E.directionalLights.needsUpdate=k,E.directionalLightShadows.needsUpdate=k,E.pointLights.needsUpdate=k,E.pointLightShadows.needsUpdate=k,E.spotLights.needsUpdate=k,E.spotLightShadows.needsUpdate=k,E.rectAreaLights.needsUpdate=k,E.hemisphereLights.needsUpdate=k}function Ds(E){return E.isMeshLambertMaterial||E.isMeshToonMaterial||E.isMeshPhongMaterial||E.isMeshStandardMaterial||E.isShadowMaterial||E.isShaderMaterial&&E.lights===!0}this.getActiveCubeFace=function(){return Y},this.getActiveMipmapLevel=function(){return z},this.getRenderTarget=function(){return le},this.setRenderTargetTextures=function(E,k,Q){let Z=ze.get(E);Z.__autoAllocateDepthBuffer=E.resolveDepthBuffer===!1,Z.__autoAllocateDepthBuffer===!1&&(Z.__useRenderToTexture=!1),ze.get(E.texture).__webglTexture=k,ze.get(E.depthTexture).__webglTexture=Z.__autoAllocateDepthBuffer?void 0:Q,Z.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(E,k){let Q=ze.get(E);Q.__webglFramebuffer=k,Q.__useDefaultFramebuffer=k===void 0},this.setRenderTarget=function(E,k=0,Q=0){le=E,Y=k,z=Q;let Z=null,$=!1,Te=!1;if(E){let Ae=ze.get(E);if(Ae.__useDefaultFramebuffer!==void 0){Me.bindFramebuffer(O.FRAMEBUFFER,Ae.__webglFramebuffer),te.copy(E.viewport),fe.copy(E.scissor),he=E.scissorTest,Me.viewport(te),Me.scissor(fe),Me.setScissorTest(he),q=-1;return}else if(Ae.__webglFramebuffer===void 0)Ke.setupRenderTarget(E);else if(Ae.__hasExternalTextures)Ke.rebindTextures(E,ze.get(E.texture).__webglTexture,ze.get(E.depthTexture).__webglTexture);else if(E.depthBuffer){let et=E.depthTexture;if(Ae.__boundDepthTexture!==et){if(et!==null&&ze.has(et)&&(E.width!==et.image.width||E.height!==et.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ke.setupDepthRenderbuffer(E)}}let Pe=E.texture;(Pe.isData3DTexture||Pe.isDataArrayTexture||Pe.isCompressedArrayTexture)&&(Te=!0);let Ge=ze.get(E).__webglFramebuffer;E.isWebGLCubeRenderTarget?(Array.isArray(Ge[k])?Z=Ge[k][Q]:Z=Ge[k],$=!0):E.samples>0&&Ke.useMultisampledRTT(E)===!1?Z=ze.get(E).__webglMultisampledFramebuffer:Array.isArray(Ge)?Z=Ge[Q]:Z=Ge,te.copy(E.viewport),fe.copy(E.scissor),he=E.scissorTest}else te.copy(Ve).multiplyScalar(Se).floor(),fe.copy(ft).multiplyScalar(Se).floor(),he=ct;if(Q!==0&&(Z=G),Me.bindFramebuffer(O.FRAMEBUFFER,Z)&&Me.drawBuffers(E,Z),Me.viewport(te),Me.scissor(fe),Me.setScissorTest(he),$){let Ae=ze.get(E.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_CUBE_MAP_POSITIVE_X+k,Ae.__webglTexture,Q)}else if(Te){let Ae=k;for(let Pe=0;Pe<E.textures.length;Pe++){let Ge=ze.get(E.textures[Pe]);O.framebufferTextureLayer(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0+Pe,Ge.__webglTexture,Q,Ae)}}else if(E!==null&&Q!==0){let Ae=ze.get(E.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Ae.__webglTexture,Q)}q=-1};function kr(E){let k=ze.get(E);return(k.__readFormat!==E.format||k.__readType!==E.type)&&(k.__readFormat=E.format,k.__readType=E.type,k.__formatReadable=at.textureFormatReadable(E.format),k.__typeReadable=at.textureTypeReadable(E.type)),k}this.readRenderTargetPixels=function(E,k,Q,Z,$,Te,Ce,Ae=0){if(!(E&&E.isWebGLRenderTarget)){Qe("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Pe=ze.get(E).__webglFramebuffer;if(E.isWebGLCubeRenderTarget&&Ce!==void 0&&(Pe=Pe[Ce],Array.isArray(Pe)&&(Pe=Pe[0])),Pe){Me.bindFramebuffer(O.FRAMEBUFFER,Pe);try{let Ge=E.textures[Ae],et=Ge.format,dt=Ge.type;E.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+Ae);let ke=kr(Ge);if(ke.__formatReadable===!1){Qe("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(ke.__typeReadable===!1){Qe("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}k>=0&&k<=E.width-Z&&Q>=0&&Q<=E.height-$&&O.readPixels(k,Q,Z,$,ge.convert(et),ge.convert(dt),Te)}finally{let Ge=le!==null?ze.get(le).__webglFramebuffer:null;Me.bindFramebuffer(O.FRAMEBUFFER,Ge)}}},this.readRenderTargetPixelsAsync=async function(E,k,Q,Z,$,Te,Ce,Ae=0){if(!(E&&E.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Pe=ze.get(E).__webglFramebuffer;if(E.isWebGLCubeRenderTarget&&Ce!==void 0&&(Pe=Pe[Ce],Array.isArray(Pe)&&(Pe=Pe[0])),Pe)if(k>=0&&k<=E.width-Z&&Q>=0&&Q<=E.height-$){Me.bindFramebuffer(O.FRAMEBUFFER,Pe);let Ge=E.textures[Ae],et=Ge.format,dt=Ge.type;E.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+Ae);let ke=kr(Ge);if(ke.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(ke.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let pt=O.createBuffer();O.bindBuffer(O.PIXEL_PACK_BUFFER,pt),O.bufferData(O.PIXEL_PACK_BUFFER,Te.byteLength,O.STREAM_READ),O.readPixels(k,Q,Z,$,ge.convert(et),ge.convert(dt),0),O.bindBuffer(O.PIXEL_PACK_BUFFER,null);let $t=le!==null?ze.get(le).__webglFramebuffer:null;Me.bindFramebuffer(O.FRAMEBUFFER,$t);let Pt=O.fenceSync(O.SYNC_GPU_COMMANDS_COMPLETE,0);return O.flush(),await hy(O,Pt,4),O.bindBuffer(O.PIXEL_PACK_BUFFER,pt),O.getBufferSubData(O.PIXEL_PACK_BUFFER,0,Te),O.bindBuffer(O.PIXEL_PACK_BUFFER,null),O.deleteBuffer(pt),O.deleteSync(Pt),Te}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(E,k=null,Q=0){let Z=Math.pow(2,-Q),$=Math.floor(E.image.width*Z),Te=Math.floor(E.image.height*Z),Ce=k!==null?k.x:0,Ae=k!==null?k.y:0;Ke.setTexture2D(E,0),O.copyTexSubImage2D(O.TEXTURE_2D,Q,0,0,Ce,Ae,$,Te),Me.unbindTexture()},this.copyTextureToTexture=function(E,k,Q=null,Z=null,$=0,Te=0){let Ce,Ae,Pe,Ge,et,dt,ke,pt,$t,Pt=E.isCompressedTexture?E.mipmaps[Te]:E.image;if(Q!==null)Ce=Q.max.x-Q.min.x,Ae=Q.max.y-Q.min.y,Pe=Q.isBox3?Q.max.z-Q.min.z:1,Ge=Q.min.x,et=Q.min.y,dt=Q.isBox3?Q.min.z:0;else{let ut=Math.pow(2,-$);Ce=Math.floor(Pt.width*ut),Ae=Math.floor(Pt.height*ut),E.isDataArrayTexture?Pe=Pt.depth:E.isData3DTexture?Pe=Math.floor(Pt.depth*ut):Pe=1,Ge=0,et=0,dt=0}Z!==null?(ke=Z.x,pt=Z.y,$t=Z.z):(ke=0,pt=0,$t=0);let Nt=ge.convert(k.format),_n=ge.convert(k.type),Oe;k.isData3DTexture?(Ke.setTexture3D(k,0),Oe=O.TEXTURE_3D):k.isDataArrayTexture||k.isCompressedArrayTexture?(Ke.setTexture2DArray(k,0),Oe=O.TEXTURE_2D_ARRAY):(Ke.setTexture2D(k,0),Oe=O.TEXTURE_2D),Me.activeTexture(O.TEXTURE0),Me.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,k.flipY),Me.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,k.premultiplyAlpha),Me.pixelStorei(O.UNPACK_ALIGNMENT,k.unpackAlignment);let ln=Me.getParameter(O.UNPACK_ROW_LENGTH),_t=Me.getParameter(O.UNPACK_IMAGE_HEIGHT),fs=Me.getParameter(O.UNPACK_SKIP_PIXELS),cn=Me.getParameter(O.UNPACK_SKIP_ROWS),Gr=Me.getParameter(O.UNPACK_SKIP_IMAGES);Me.pixelStorei(O.UNPACK_ROW_LENGTH,Pt.width),Me.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Pt.height),Me.pixelStorei(O.UNPACK_SKIP_PIXELS,Ge),Me.pixelStorei(O.UNPACK_SKIP_ROWS,et),Me.pixelStorei(O.UNPACK_SKIP_IMAGES,dt);let Ki=E.isDataArrayTexture||E.isData3DTexture,ds=k.isDataArrayTexture||k.isData3DTexture;if(E.isDepthTexture){let ut=ze.get(E),en=ze.get(k),Hn=ze.get(ut.__renderTarget),Lt=ze.get(en.__renderTarget);Me.bindFramebuffer(O.READ_FRAMEBUFFER,Hn.__webglFramebuffer),Me.bindFramebuffer(O.DRAW_FRAMEBUFFER,Lt.__webglFramebuffer);for(let un=0;un<Pe;un++)Ki&&(O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,ze.get(E).__webglTexture,$,dt+un),O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,ze.get(k).__webglTexture,Te,$t+un)),O.blitFramebuffer(Ge,et,Ge+Ce,et+Ae,ke,pt,ke+Ce,pt+Ae,O.DEPTH_BUFFER_BIT,O.NEAREST);Me.bindFramebuffer(O.READ_FRAMEBUFFER,null),Me.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else if($!==0||E.isRenderTargetTexture||ze.has(E)){let ut=ze.get(E),en=ze.get(k);Me.bindFramebuffer(O.READ_FRAMEBUFFER,N),Me.bindFramebuffer(O.DRAW_FRAMEBUFFER,V);for(let Hn=0;Hn<Pe;Hn++)Ki?O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,ut.__webglTexture,$,dt+Hn):O.framebufferTexture2D(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,ut.__webglTexture,$),ds?O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,en.__webglTexture,Te,$t+Hn):O.framebufferTexture2D(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,en.__webglTexture,Te),$!==0?O.blitFramebuffer(Ge,et,Ge+Ce,et+Ae,ke,pt,ke+Ce,pt+Ae,O.COLOR_BUFFER_BIT,O.NEAREST):ds?O.copyTexSubImage3D(Oe,Te,ke,pt,$t+Hn,Ge,et,Ce,Ae):O.copyTexSubImage2D(Oe,Te,ke,pt,Ge,et,Ce,Ae);Me.bindFramebuffer(O.READ_FRAMEBUFFER,null),Me.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else ds?E.isDataTexture||E.isData3DTexture?O.texSubImage3D(Oe,Te,ke,pt,$t,Ce,Ae,Pe,Nt,_n,Pt.data):k.isCompressedArrayTexture?O.compressedTexSubImage3D(Oe,Te,ke,pt,$t,Ce,Ae,Pe,Nt,Pt.data):O.texSubImage3D(Oe,Te,ke,pt,$t,Ce,Ae,Pe,Nt,_n,Pt):E.isDataTexture?O.texSubImage2D(O.TEXTURE_2D,Te,ke,pt,Ce,Ae,Nt,_n,Pt.data):E.isCompressedTexture?O.compressedTexSubImage2D(O.TEXTURE_2D,Te,ke,pt,Pt.width,Pt.height,Nt,Pt.data):O.texSubImage2D(O.TEXTURE_2D,Te,ke,pt,Ce,Ae,Nt,_n,Pt);Me.pixelStorei(O.UNPACK_ROW_LENGTH,ln),Me.pixelStorei(O.UNPACK_IMAGE_HEIGHT,_t),Me.pixelStorei(O.UNPACK_SKIP_PIXELS,fs),Me.pixelStorei(O.UNPACK_SKIP_ROWS,cn),Me.pixelStorei(O.UNPACK_SKIP_IMAGES,Gr),Te===0&&k.generateMipmaps===!0&&k.mipmapsAutoUpdate===!0&&O.generateMipmap(Oe),Me.unbindTexture()},this.initRenderTarget=function(E){ze.get(E).__webglFramebuffer===void 0&&Ke.setupRenderTarget(E)},this.initTexture=function(E){E.isCubeTexture?Ke.setTextureCube(E,0):E.isData3DTexture?Ke.setTexture3D(E,0):E.isDataArrayTexture||E.isCompressedArrayTexture?Ke.setTexture2DArray(E,0):Ke.setTexture2D(E,0),Me.unbindTexture()},this.resetState=function(){Y=0,z=0,le=null,Me.reset(),be.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Ei}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=xt._getDrawingBufferColorSpace(e),t.unpackColorSpace=xt._getUnpackColorSpace()}};var gR=new Uint8Array,jo=(n,e,t)=>Math.max(e,Math.min(t,n)),Jy=n=>new Int16Array(n.slice(0,n.length&-2).buffer);function $y(n){let e=Jy(n),t=new Float32Array(7*Math.floor(e.length/6));for(let i=0,s=0;s<t.length;i+=6,s+=7){let[r,o,a]=[e[i+3],e[i+4],e[i+5]],c=Math.hypot(r,o,a),l=c*1e-4/2,u=c>0?Math.sin(l)/c:0;for(let h=0;h<3;h+=1)t[s+h]=e[i+h]*1e-4;t.set([r*u,o*u,a*u,Math.cos(l)],s+3)}return t}function Tl(n,e){let[t,i]=[0,n.length];for(;t<i;){let s=t+i>>1;n[s].shown_s<=e?t=s+1:i=s}return t-1}var lh=class{time_s=0;newest_s=0;live=!0;paused=!1;speed=1;received=0;tracks=[];samples=[];pace=1;arrived_s=0;pause_s=.1;clear(){this.tracks=[],this.time_s=this.newest_s=0,this.pace=1,this.goLive()}add(e){this.received+=1;let{robot:t,shownS:i}=e,s=this.tracks[t]?.at(-1)?.shown_s??-1;if(i===s)return;i<s&&this.clear(),i>this.newest_s&&this.arrive(performance.now()/1e3);let r=this.tracks[t]??=[],[o,a]=[$y(e.bodies),$y(e.ghost)];r.push({frame:e,shown_s:i,bodies:o,contacts:Jy(e.contacts),ghost:a}),e.bodies=e.contacts=e.ghost=gR;let c=Tl(r,i-60);c>=64&&r.splice(0,c),this.newest_s=Math.max(this.newest_s,i)}arrive(e){let t=Math.min(.25,e-this.arrived_s);this.pause_s=Math.max(t,.98*this.pause_s),this.arrived_s=e}get age_s(){return this.newest_s-this.time_s+performance.now()/1e3-this.arrived_s}get oldest_s(){return Math.min(this.newest_s,...Array.from(this.tracks,e=>e?.[0]?.shown_s??1/0))}advance(e){let t=this.newest_s-jo(1.15*this.pause_s,.02,.25),i=t-this.time_s;this.live&&Math.abs(i)>1?this.time_s=t:this.live?(this.time_s+=Math.max(0,e*(this.pace+3*i)),this.pace=jo(this.pace+e*i,0,4)):this.paused||(this.time_s+=e*this.speed,this.live=this.speed===1&&this.time_s>=t),this.time_s=jo(this.time_s,this.oldest_s,this.newest_s)}goLive(){[this.live,this.paused,this.speed]=[!0,!1,1]}pause(e){[this.live,this.paused]=[!1,e]}setSpeed(e){this.speed=e,this.live&&=e===1}scrub(e){this.live=!1,this.time_s=jo(e,this.oldest_s,this.newest_s)}step(e){this.pause(!0);let t=this.tracks.find(o=>o?.length>0)??[],i=Tl(t,this.time_s),s=i>=0&&t[i].shown_s<this.time_s,r=e===1?i+1:s?i:i-1;this.time_s=t[jo(r,0,t.length-1)]?.shown_s??this.time_s}sample(e){let t=this.tracks[e]??[],i=Math.max(0,Tl(t,this.time_s)),s=t[i];if(s===void 0)return;let r=t[i+1]??s,o=r.shown_s-s.shown_s;(r.frame.episode!==s.frame.episode||o>.5)&&(r=s);let a=r===s?0:jo((this.time_s-s.shown_s)/o,0,1);return Object.assign(this.samples[e]??={before:s,after:r,mix:a},{before:s,after:r,mix:a})}visit(e,t,i){let s=this.tracks[e]??[],r=Tl(s,this.time_s);for(let o=Math.max(0,Tl(s,this.time_s-t));o<=r;o+=1)i(s[o])}newest(e){return this.tracks[e]?.at(-1)?.frame}};var yR=.1,xR=3,vR=.0015,bR=.5,SR=1.2,MR=5,ER=.05,ch=512,TR=.05,jy=new W(0,0,1),Ns=class{constructor(e,t,i=!1){this.radius_m=t;let r={...{color:e,emissive:e,emissiveIntensity:.45,roughness:.6},depthTest:!i,transparent:i},o=a=>{a.translate(0,.5,0).rotateX(Math.PI/2);let c=new Js(a,new pi(r),ch);return c.frustumCulled=!1,c.renderOrder=i?1:0,this.group.add(c),c};this.shafts=o(new zo(1,1,1,10)),this.heads=o(new nl(1,1,16))}radius_m;group=new On;shafts;heads;turn=new bn;along=new W;scale=new W;matrix=new Tt;begin(){this.shafts.count=this.heads.count=0,this.shafts.instanceMatrix.needsUpdate=this.heads.instanceMatrix.needsUpdate=!0}rod(e,t){this.along.subVectors(t,e);let i=this.along.length();i<1e-4||this.shafts.count===ch||(this.turn.setFromUnitVectors(jy,this.along.divideScalar(i)),this.scale.set(this.radius_m,this.radius_m,i),this.shafts.setMatrixAt(this.shafts.count++,this.matrix.compose(e,this.turn,this.scale)))}arrow(e,t){let i=Math.min(t.length(),SR);if(i<.001||this.heads.count===ch)return;let s=Math.min(5*this.radius_m,.6*i);this.rod(e,t.setLength(i-s).add(e)),this.scale.set(.5*s,.5*s,s),this.heads.setMatrixAt(this.heads.count++,this.matrix.compose(t,this.turn,this.scale))}};function AR(){let[n,e]=[[16,22,32,255],[255,255,255,255]],t=Uint8Array.from([n,e,n,e,e,n,e,n].flatMap(a=>a??[])),i=new Ar(t,4,2);i.needsUpdate=!0;let s=new $s({map:i,depthTest:!1,transparent:!0,toneMapped:!1}),r=new Rr(TR,24,16).rotateX(Math.PI/2),o=new Js(r,s,ch);return o.frustumCulled=!1,o.renderOrder=2,o}var Qy=["contacts","command","velocity","trail","left","right","centre"],uh=class{group=new On;rods={contacts:new Ns(15022139,.01),command:new Ns(2863692,.016),velocity:new Ns(3111926,.016),trail:new Ns(16103168,.007),left:new Ns(1222048,.006),right:new Ns(14371483,.006),centre:new Ns(10182117,.006,!0)};isFlat=!0;balls=AR();matrix=new Tt;from=new W;to=new W;turn=new bn;part=new W;constructor(){for(let e of Object.values(this.rods))this.group.add(e.group);this.rods.centre.group.add(this.balls)}draw(e,t){for(let i of Object.values(this.rods))i.begin();this.balls.count=0,this.balls.instanceMatrix.needsUpdate=!0;for(let[i,s]of e.entries()){let r=t.sample(i);r!==void 0&&this.add(s,r,t,i)}}add(e,t,i,s){let{frame:r,contacts:o}=t.mix<.5?t.before:t.after;for(let l=0;l+5<o.length;l+=6)this.to.fromArray(o,l+3).multiplyScalar(yR),!(this.to.length()<xR)&&(this.from.fromArray(o,l).multiplyScalar(1e-4).add(e.base),this.rods.contacts.arrow(this.from,this.to.multiplyScalar(vR)));this.velocity(this.rods.command,e,r.command,.16),this.velocity(this.rods.velocity,e,r.velocity,.1);let{episode:a}=t.before.frame,c=(l,u)=>{l.group.visible&&this.trail(l,e,a,i,s,u)};c(this.rods.trail);for(let l of e.feet.left)c(this.rods.left,l);for(let l of e.feet.right)c(this.rods.right,l);e.hasCentre&&this.rods.centre.group.visible&&this.centre(e)}at(e,{body:t,at:i}){let{position:s,quaternion:r}=e.bodies[t];return this.to.copy(i).applyQuaternion(r).add(s).add(e.base)}centre(e){this.balls.setMatrixAt(this.balls.count++,this.matrix.makeTranslation(e.centre));let t=[...e.feet.left,...e.feet.right],i=Math.min(...t.map(r=>this.at(e,r).z)),s=this.isFlat||t.length===0?0:i;this.rods.centre.rod(e.centre,this.to.copy(e.centre).setZ(s))}velocity(e,t,[i,s],r){i===void 0||s===void 0||(this.from.copy(t.base).setZ(t.base.z+t.top_m+r),this.to.set(i,s,0).multiplyScalar(bR).applyAxisAngle(jy,t.yaw_rad),e.arrow(this.from,this.to))}trail(e,t,i,s,r,o){let a=-1/0;s.visit(r,MR,({frame:c,shown_s:l,bodies:u})=>{if(!(c.episode!==i||l<a+ER)){if(this.to.fromArray(c.baseM),this.to.y+=t.offset_m,o!==void 0){let h=7*o.body;this.to.add(this.part.fromArray(u,h)),this.to.add(this.part.copy(o.at).applyQuaternion(this.turn.fromArray(u,h+3)))}a>0&&e.rod(this.from,this.to),this.from.copy(this.to),a=l}}),a>0&&e.rod(this.from,o===void 0?t.base:this.at(t,o))}};var ex=10,wR=50,RR=1e3,tx=({arrived_ms:n},e)=>Math.max(0,e-n)/1e3,nx=n=>`${Math.round(100*n)} %`;function hh(n){if(n<10)return`${n.toFixed(1)} s`;let e=n<120?1:60;return Zf(e*Math.round(n/e))}var ix=n=>n.split("`").map((e,t)=>t%2===1?tt("code","",e):e);function IR({name:n,alive:e,quarantined:t,stats:i,lagVersions:s,sinceContactS:r}){let o=e?"alive":"silent",a=tt("th","",n,tt("span","",i?.host??""));[a.scope,a.title]=["row",`${n} ${i?.host??""}`],t&&a.append(tt("b","","quarantined"));let c=[i&&Si(i.envStepsPerS),s?.toString(),r===void 0?void 0:hh(r)];return tt("tr","",a,tt("td",o,o),...c.map(l=>tt("td","",l??"–")))}function CR({status:n,actors:e,alive:t}){if(e===0)return[tt("h3","","No actors")];let i=["actor","state","steps/s","lag","contact"].map(o=>tt("th","",o)),s=n.actors.slice(0,wR).map(IR),r=e-s.length;return[tt("h3","",`Actors: ${t} of ${e} alive, slowest first`),tt("table","actors",tt("thead","",tt("tr","",...i)),tt("tbody","",...s)),...r>0?[tt("p","caption",`and ${r} more`)]:[]]}function PR({parts:n,limit:e,limitHelp:t}){if(n.length===0)return[];let i=n.map(({name:r,share:o})=>{let a=tt("i");a.style.transform=`scaleX(${Math.min(1,o)})`;let c=r===e?`${r} (the limit)`:r,l=tt("output","",nx(o));return tt("div",r===e?"term limit":"term",a,tt("span","",c),l)}),s=t===""?[]:[tt("p","help","To speed up: ",...ix(t))];return[tt("h3","","Time of a round"),tt("div","parts",...i),...s]}function NR(n,e){let{status:t}=n,i=tx(n,e),s=i>ex,r=s?`status is ${hh(i)} old`:($f[t.phase]??"").toLowerCase(),[o,a]=[Number(t.envSteps),Number(t.envStepsWanted)],c=tt("progress");[c.max,c.value,c.ariaLabel]=[Math.max(1,a),o,"Steps of the run"];let l=(a-o)/t.envStepsPerS,u=l>0&&Number.isFinite(l)?`, ${hh(l)} left`:"",h=[["steps/s",Si(t.envStepsPerS)],["policy lag",t.policyLagMean.toFixed(2)],["used share",t.usedShare===void 0?"–":nx(t.usedShare)],["updated",`${hh(t.sinceUpdateS)} ago`]];return tt("section",s?"run old":"run",tt("h2","",tt("b","",t.run),tt("span","",r)),c,tt("p","caption",`${Si(o)} of ${Si(a)} steps${u}`),tt("dl","facts",...h.flatMap(([f,d])=>[tt("dt","",f),tt("dd","",d)])),...PR(t),...CR(n))}var fh=class{runs=new Map;alarms=De("alarms");alarmCount=0;drawn_ms=-1/0;restart(){this.runs.clear(),this.drawn_ms=-1/0}add({status:e,actors:t,alive:i}){if(e===void 0)return;let s=this.runs.get(e.run);e.timeUnixS>0&&s?.status.timeUnixS===e.timeUnixS||(this.runs.set(e.run,{status:e,actors:t,alive:i,arrived_ms:performance.now()}),this.drawn_ms=-1/0)}update(e){if(e-this.drawn_ms<RR||this.isSelected())return this.runs.size>0;this.drawn_ms=e;let t=[...this.runs.values()];return De("fleet-body").replaceChildren(...t.map(i=>NR(i,e))),this.showAlarms(t.filter(i=>tx(i,e)<=ex).map(({status:i})=>i)),t.length>0}get counts(){let e=t=>document.querySelectorAll(t).length;return{runs:e("#fleet .run"),actors:e(".actors tbody tr"),alarms:e("#alarms li")}}isSelected(){let e=getSelection();return e===null||e.isCollapsed?!1:[this.alarms,De("fleet-body")].some(t=>e.containsNode(t,!0))}showAlarms(e){let t=s=>e.length>1?[tt("b","",s)]:[],i=e.flatMap(({run:s,alarms:r})=>r.map(o=>tt("li","",...t(s),...ix(o))));i.length>this.alarmCount&&(this.alarms.open=!0),this.alarmCount=i.length,this.alarms.hidden=i.length===0,Jt(De("alarm-count"),i.length===1?"1 alarm":`${i.length} alarms`),De("alarm-list").replaceChildren(...i)}};var LR=2,ax=5,sx=84,DR=.99,rx=.001;function ox(n,e,t){n.replaceChildren();let i=e.filter(Number.isFinite),s={width:1.5,points:{show:!1}},r={...s,stroke:()=>co("red"),width:1,dash:[4,4]},o={width:n.clientWidth||260,height:sx,padding:[5,8,0,0],cursor:{show:!1},scales:{x:{time:!1,range:[-ax,0]}},axes:qf(c=>`${c} s`,20),series:[{},...t.map(c=>({...s,stroke:()=>co(c)})),...i.map(()=>r)]},a=new dn(o,[[],...[...t,...i].map(()=>[])],n);return(c,...l)=>{let u=n.clientWidth;u!==a.width&&u>0&&a.setSize({width:u,height:sx}),a.setData([c,...l,...i.map(h=>c.map(()=>h))])}}var dh=class{constructor(e){this.timeline=e;Un("robot").addEventListener("change",()=>this.choose(Number(Un("robot").value))),Un("hinge").addEventListener("change",()=>this.chooseHinge())}timeline;robot=0;robots=[];terms=[];largest=0;plots=[];setRobots(e){this.robots=e,Un("robot").replaceChildren(...e.map((t,i)=>lo(String(i),t.name))),Un("robot").hidden=e.length<2,this.choose(0)}choose(e){this.robot=e;let{rewardTerms:t=[],hinges:i=[]}=this.robots[e]??{};this.largest=0,De("rewards").replaceChildren(),this.terms=t.map(s=>{let[r,o]=[tt("i"),tt("output")];return De("rewards").append(tt("div","term",r,tt("span","",s),o)),{value:o,bar:r}}),De("rewards-head").hidden=t.length===0,Un("hinge").replaceChildren(...i.map((s,r)=>lo(String(r),s.name))),De("hinges").hidden=i.length===0,this.chooseHinge()}chooseHinge(){let e=this.robots[this.robot]?.hinges[Number(Un("hinge").value)],t=e?.effortNm||1/0;if(e===void 0)return;let i=ox(De("angle-plot"),[e.lowRad,e.highRad],["blue","yellow"]);this.plots=[i,ox(De("torque-plot"),[-t,t],["blue"])]}update(){let e=this.timeline.sample(this.robot)?.before.frame;if(!(e===void 0||De("numbers-body").clientWidth===0)){Jt(De("time"),`${e.timeS.toFixed(2)} s`),Jt(De("episode"),String(e.episode)),Jt(De("distance"),`${e.distanceM.toFixed(2)} m`),this.velocities(e),this.largest=Math.max(.001,DR*this.largest,...e.rewardsE3.map(t=>Math.abs(t)*rx));for(let[t,{value:i,bar:s}]of this.terms.entries()){let r=(e.rewardsE3[t]??0)*rx;Jt(i,r.toFixed(3)),s.style.transform=`scaleX(${r/this.largest})`,s.className=r<0?"negative":""}this.joint(e)}}velocities({episode:e,command:t,velocity:i}){De("velocities").hidden=i.length===0;let s=[0,0,0],r=0;this.timeline.visit(this.robot,LR,({frame:o})=>{if(!(o.episode!==e||o.command.length<3||o.velocity.length<3)){r+=1;for(let a=0;a<3;a+=1)s[a]+=Math.abs(o.command[a]-o.velocity[a])}});for(let[o,a]of[...De("velocities").tBodies[0].rows].entries()){let c=[t[o],i[o],r>0?s[o]/r:void 0];for(let[l,u]of c.entries())Jt(a.cells[l+1],u?.toFixed(2)??"–")}}joint(e){let t=Number(Un("hinge").value),{isServo:i=!1}=this.robots[this.robot]?.hinges[t]??{},s=(d,p)=>t in d?d[t]/p:null,r=({anglesMrad:d})=>s(d,1e3),o=({controlsE2:d})=>s(d,100),a=d=>(d.torquesCnm[t]??0)/100,[c,l,u,h]=[[],[],[],[]];this.timeline.visit(this.robot,ax,({shown_s:d,frame:p})=>{c.push(d-this.timeline.time_s),l.push(r(p)),u.push(i?o(p):null),h.push(a(p))}),this.plots[0]?.(c,l,u),this.plots[1]?.(c,h);let f=o(e)?.toFixed(2)??"–";Jt(De("angle"),r(e)?.toFixed(3)??"–"),Jt(De("target"),i?`target ${f}`:""),Jt(De("torque"),a(e).toFixed(2)),Jt(De("control"),i?"":`action ${f}`)}};var lx=["forward","left","turn"],UR=["m/s","m/s","rad/s"],cx=["ws","ad","qe"],ux=.1,hx=.15,OR=50;function gp(n,e,t){let i=ei(n),s=i.nextElementSibling,r=o=>Jt(s,e(o));return i.addEventListener("input",()=>{r(i.valueAsNumber),t?.(i.valueAsNumber)}),r(i.valueAsNumber),o=>r(i.valueAsNumber=o)}var _p=n=>`× ${n.toFixed(2)}`,yp=[["mass","massScale",1,_p],["friction","frictionScale",1,_p],["motor","motorScale",1,_p],["delay","actionDelaySteps",0,n=>`${n} ${n===1?"step":"steps"}`],["level","groundLevel",0,n=>`level ${n}`]],ph=class{constructor(e){this.connection=e;uo(t=>{if(!this.commands)return;(t==="x"||t==="0")&&this.setAll([0,0,0]);let i=cx.findIndex(o=>o.includes(t));if(i<0)return;let s=this.follows?this.command:[0,0,0],r=Math.round(s[i]/ux)+(cx[i][0]===t?1:-1);this.setAll(s.map((o,a)=>a===i?r*ux:o))}),De("stop").addEventListener("click",()=>this.setAll([0,0,0])),De("own").addEventListener("click",()=>{this.follows=this.others=!1,this.send()}),gp("strength",t=>`${t.toFixed(2)} m/s`);for(let t of document.querySelectorAll("[data-push]"))t.addEventListener("click",()=>{let i=ei("strength").valueAsNumber,[s,r]=t.dataset.push.split(" ").map(o=>Number(o)*i);this.connection.send({case:"push",value:{forwardMps:s,leftMps:r}})});De("apply").addEventListener("click",()=>{let t=Object.fromEntries(yp.map(([i,s])=>[s,ei(i).valueAsNumber]));this.connection.send({case:"world",value:t})})}connection;steers=!1;commands=!1;follows=!1;command=[0,0,0];low=[];high=[];sliders=lx.map((e,t)=>gp(e,i=>`${i.toFixed(2)} ${UR[t]}`,i=>this.set(t,i)));world=yp.map(([e,,,t])=>gp(e,t));stickUsed=!1;stickRested=!1;stick_ms=0;others=!1;isNew=!0;setScene(e){this.steers=e.steers,[this.low,this.high]=[e.commandLow,e.commandHigh],this.commands=this.steers&&this.low.length===3&&this.high.length===3,De("read-only").hidden=e.steers,De("push").hidden=De("world").hidden=!e.steers,De("commands").hidden=!this.commands,De("level-row").hidden=e.groundLevels===0,ei("level").max=String(Math.max(1,e.groundLevels)-1);for(let[t,i]of lx.entries())[ei(i).min,ei(i).max]=[String(this.low[t]??0),String(this.high[t]??0)];for(let[t,[,i,s]]of yp.entries())this.world[t](e.world?.[i]??s)}get othersSteer(){return this.others}reconnect(){this.isNew=!0}setSteerer(e){let t=this.isNew&&this.follows&&e===0;if(this.isNew=!1,t)return this.send();this.follows=e===1,this.others=e===2,this.others&&(this.stickUsed=this.stickRested=!1)}update(e){if(this.commands&&(Jt(De("followed"),this.follows?"(yours)":this.others?"another page steers":"(the robot's own)"),De("followed").classList.toggle("others",this.others),Hs(De("own"),!this.follows&&!this.others),!(this.follows||e?.command.length!==3)))for(let[t,i]of this.sliders.entries())i(this.command[t]=e.command[t])}poll(e){if(!this.commands||e-this.stick_ms<OR)return;this.stick_ms=e;let t=(navigator.getGamepads?.()??[]).filter(l=>l?.connected&&l.axes.length>=3),i=t.find(l=>l?.mapping==="standard")??t[0],s=l=>Math.sign(l)*Math.max(0,Math.abs(l)-hx)/(1-hx),r=[1,0,2].map(l=>s(-(i?.axes[l]??0))),o=r.some(l=>l!==0);if(this.stickRested||=!o&&i!==void 0,!this.stickRested||!o&&!this.stickUsed)return;this.stickUsed=o;let a=(l,u)=>l>0?this.high[u]:-this.low[u],c=r.map((l,u)=>this.clamp(u,l*a(l,u)));c.some((l,u)=>Math.abs(l-this.command[u])>.01)&&this.setAll(c)}clamp(e,t){return Math.max(this.low[e],Math.min(this.high[e],t))}set(e,t){this.setAll(this.command.map((i,s)=>s===e?t:i))}setAll(e){[this.follows,this.others]=[!0,!1];for(let[t,i]of this.sliders.entries())i(this.command[t]=this.clamp(t,e[t]));this.send()}send(){let[e,t,i]=this.command;this.connection.send({case:"command",value:{follows:this.follows,forwardMps:e,leftMps:t,yawRadps:i}})}};var FR=60,BR=12e6;function fx(n,e){let t=document.createElement("a");t.href=URL.createObjectURL(n),t.download=`treadmill-${new Date().toISOString().slice(0,19).replaceAll(":","-")}.${e}`,t.click(),setTimeout(()=>URL.revokeObjectURL(t.href),1e4)}var mh=class{constructor(e,t){this.timeline=e;this.view=t;let i={" ":["play",()=>e.pause(!e.paused)],ArrowLeft:["back",()=>e.step(-1)],ArrowRight:["forth",()=>e.step(1)],l:["live",()=>e.goLive()],p:["picture",()=>{t.picture(e).then(s=>s&&fx(s,"png"))}],v:["film",()=>this.record()]};for(let[s,r]of Object.values(i))De(s).addEventListener("click",r);uo((s,r)=>{s in i&&(r.preventDefault(),i[s][1]())}),this.speed.addEventListener("change",()=>e.setSpeed(Number(this.speed.value))),this.scrub.addEventListener("input",()=>{Number(this.scrub.value)===0?e.goLive():e.scrub(e.newest_s+Number(this.scrub.value))}),De("full").addEventListener("click",()=>{let{fullscreenElement:s,documentElement:r}=document;(s===null?r.requestFullscreen():document.exitFullscreen()).catch(()=>{})}),document.addEventListener("fullscreenchange",()=>Hs(De("full"),document.fullscreenElement!==null)),De("full").hidden=!document.fullscreenEnabled,this.film.hidden=typeof MediaRecorder>"u"}timeline;view;play=De("play");speed=Un("speed");scrub=ei("scrub");film=De("film");recorder;update(){let{timeline:e}=this;this.play.classList.toggle("paused",e.paused),this.play.ariaLabel=e.paused?"Play":"Pause",De("live").classList.toggle("on",e.live),this.speed.value=String(e.speed);let t=e.live?0:e.newest_s-e.time_s;this.scrub.min=String(-Math.max(1,e.newest_s-e.oldest_s)),this.scrub.value=String(-t),Jt(De("behind"),e.live?"":`−${t.toFixed(2)} s`)}record(){if(this.recorder!==void 0)return this.recorder.stop();let t=["video/webm;codecs=vp9","video/webm","video/mp4"].find(o=>MediaRecorder.isTypeSupported(o))??"",i=this.view.canvas.captureStream(FR),s=new MediaRecorder(i,{mimeType:t,videoBitsPerSecond:BR}),r=[];s.ondataavailable=o=>r.push(o.data),s.onstop=()=>{this.recorder=void 0,Hs(this.film,!1);let{mimeType:o}=s;fx(new Blob(r,{type:o}),o.includes("mp4")?"mp4":"webm")},s.start(1e3),this.recorder=s,Hs(this.film,!0)}};var dx={type:"change"},vp={type:"start"},mx={type:"end"},gh=new ko,px=new $n,kR=Math.cos(70*nh.DEG2RAD),An=new W,ni=2*Math.PI,At={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},xp=1e-6,_h=class extends ul{constructor(e,t=null){super(e,t),this.state=At.NONE,this.target=new W,this.cursor=new W,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:ir.ROTATE,MIDDLE:ir.DOLLY,RIGHT:ir.PAN},this.touches={ONE:sr.ROTATE,TWO:sr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new W,this._lastQuaternion=new bn,this._lastTargetPosition=new W,this._quat=new bn().setFromUnitVectors(e.up,new W(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Wo,this._sphericalDelta=new Wo,this._scale=1,this._panOffset=new W,this._rotateStart=new We,this._rotateEnd=new We,this._rotateDelta=new We,this._panStart=new We,this._panEnd=new We,this._panDelta=new We,this._dollyStart=new We,this._dollyEnd=new We,this._dollyDelta=new We,this._dollyDirection=new W,this._mouse=new We,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=zR.bind(this),this._onPointerDown=GR.bind(this),this._onPointerUp=VR.bind(this),this._onContextMenu=qR.bind(this),this._onMouseWheel=XR.bind(this),this._onKeyDown=YR.bind(this),this._onTouchStart=KR.bind(this),this._onTouchMove=ZR.bind(this),this._onMouseDown=HR.bind(this),this._onMouseMove=WR.bind(this),this._interceptControlDown=$R.bind(this),this._interceptControlUp=JR.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(e){this._cursorStyle=e,e==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(e){super.connect(e),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=At.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(e){e.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=e}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(dx),this.update(),this.state=At.NONE}pan(e,t){this._pan(e,t),this.update()}dollyIn(e){this._dollyIn(e),this.update()}dollyOut(e){this._dollyOut(e),this.update()}rotateLeft(e){this._rotateLeft(e),this.update()}rotateUp(e){this._rotateUp(e),this.update()}update(e=null){let t=this.object.position;An.copy(t).sub(this.target),An.applyQuaternion(this._quat),this._spherical.setFromVector3(An),this.autoRotate&&this.state===At.NONE&&this._rotateLeft(this._getAutoRotationAngle(e)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(i)&&isFinite(s)&&(i<-Math.PI?i+=ni:i>Math.PI&&(i-=ni),s<-Math.PI?s+=ni:s>Math.PI&&(s-=ni),i<=s?this._spherical.theta=Math.max(i,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+s)/2?Math.max(i,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(An.setFromSpherical(this._spherical),An.applyQuaternion(this._quatInverse),t.copy(this.target).add(An),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=An.length();o=this._clampDistance(a*this._scale);let c=a-o;this.object.position.addScaledVector(this._dollyDirection,c),this.object.updateMatrixWorld(),r=!!c}else if(this.object.isOrthographicCamera){let a=new W(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let c=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=c!==this.object.zoom;let l=new W(this._mouse.x,this._mouse.y,0);l.unproject(this.object),this.object.position.sub(l).add(a),this.object.updateMatrixWorld(),o=An.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(gh.origin.copy(this.object.position),gh.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(gh.direction))<kR?this.object.lookAt(this.target):(px.setFromNormalAndCoplanarPoint(this.object.up,this.target),gh.intersectPlane(px,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>xp||8*(1-this._lastQuaternion.dot(this.object.quaternion))>xp||this._lastTargetPosition.distanceToSquared(this.target)>xp?(this.dispatchEvent(dx),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(e){return e!==null?ni/60*this.autoRotateSpeed*e:ni/60/60*this.autoRotateSpeed}_getZoomScale(e){let t=Math.abs(e*.01);return Math.pow(.95,this.zoomSpeed*t)}_rotateLeft(e){this._sphericalDelta.theta-=e}_rotateUp(e){this._sphericalDelta.phi-=e}_panLeft(e,t){An.setFromMatrixColumn(t,0),An.multiplyScalar(-e),this._panOffset.add(An)}_panUp(e,t){this.screenSpacePanning===!0?An.setFromMatrixColumn(t,1):(An.setFromMatrixColumn(t,0),An.crossVectors(this.object.up,An)),An.multiplyScalar(e),this._panOffset.add(An)}_pan(e,t){let i=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;An.copy(s).sub(this.target);let r=An.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*e*r/i.clientHeight,this.object.matrix),this._panUp(2*t*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(e*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(t*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(e,t){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),s=e-i.left,r=t-i.top,o=i.width,a=i.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(e){return Math.max(this.minDistance,Math.min(this.maxDistance,e))}_handleMouseDownRotate(e){this._rotateStart.set(e.clientX,e.clientY)}_handleMouseDownDolly(e){this._updateZoomParameters(e.clientX,e.clientY),this._dollyStart.set(e.clientX,e.clientY)}_handleMouseDownPan(e){this._panStart.set(e.clientX,e.clientY)}_handleMouseMoveRotate(e){this._rotateEnd.set(e.clientX,e.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(ni*this._rotateDelta.x/t.clientHeight),this._rotateUp(ni*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(e){this._dollyEnd.set(e.clientX,e.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(e){this._panEnd.set(e.clientX,e.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(e){this._updateZoomParameters(e.clientX,e.clientY),e.deltaY<0?this._dollyIn(this._getZoomScale(e.deltaY)):e.deltaY>0&&this._dollyOut(this._getZoomScale(e.deltaY)),this.update()}_handleKeyDown(e){let t=!1;switch(e.code){case this.keys.UP:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(ni*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),t=!0;break;case this.keys.BOTTOM:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(-ni*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),t=!0;break;case this.keys.LEFT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(ni*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),t=!0;break;case this.keys.RIGHT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(-ni*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),t=!0;break}t&&(e.preventDefault(),this.update())}_handleTouchStartRotate(e){if(this._pointers.length===1)this._rotateStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._rotateStart.set(i,s)}}_handleTouchStartPan(e){if(this._pointers.length===1)this._panStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panStart.set(i,s)}}_handleTouchStartDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enablePan&&this._handleTouchStartPan(e)}_handleTouchStartDollyRotate(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enableRotate&&this._handleTouchStartRotate(e)}_handleTouchMoveRotate(e){if(this._pointers.length==1)this._rotateEnd.set(e.pageX,e.pageY);else{let i=this._getSecondPointerPosition(e),s=.5*(e.pageX+i.x),r=.5*(e.pageY+i.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(ni*this._rotateDelta.x/t.clientHeight),this._rotateUp(ni*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(e){if(this._pointers.length===1)this._panEnd.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panEnd.set(i,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(e.pageX+t.x)*.5,a=(e.pageY+t.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enablePan&&this._handleTouchMovePan(e)}_handleTouchMoveDollyRotate(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enableRotate&&this._handleTouchMoveRotate(e)}_addPointer(e){this._pointers.push(e.pointerId)}_removePointer(e){delete this._pointerPositions[e.pointerId];for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId){this._pointers.splice(t,1);return}}_isTrackingPointer(e){for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId)return!0;return!1}_trackPointer(e){let t=this._pointerPositions[e.pointerId];t===void 0&&(t=new We,this._pointerPositions[e.pointerId]=t),t.set(e.pageX,e.pageY)}_getSecondPointerPosition(e){let t=e.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[t]}_customWheelEvent(e){let t=e.deltaMode,i={clientX:e.clientX,clientY:e.clientY,deltaY:e.deltaY};switch(t){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return e.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function GR(n){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(n.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(n)&&(this._addPointer(n),n.pointerType==="touch"?this._onTouchStart(n):this._onMouseDown(n),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function zR(n){this.enabled!==!1&&(n.pointerType==="touch"?this._onTouchMove(n):this._onMouseMove(n))}function VR(n){switch(this._removePointer(n),this._pointers.length){case 0:this.domElement.releasePointerCapture(n.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(mx),this.state=At.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let e=this._pointers[0],t=this._pointerPositions[e];this._onTouchStart({pointerId:e,pageX:t.x,pageY:t.y});break}}function HR(n){let e;switch(n.button){case 0:e=this.mouseButtons.LEFT;break;case 1:e=this.mouseButtons.MIDDLE;break;case 2:e=this.mouseButtons.RIGHT;break;default:e=-1}switch(e){case ir.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(n),this.state=At.DOLLY;break;case ir.ROTATE:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=At.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=At.ROTATE}break;case ir.PAN:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=At.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=At.PAN}break;default:this.state=At.NONE}this.state!==At.NONE&&this.dispatchEvent(vp)}function WR(n){switch(this.state){case At.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(n);break;case At.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(n);break;case At.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(n);break}}function XR(n){this.enabled===!1||this.enableZoom===!1||this.state!==At.NONE||(n.preventDefault(),this.dispatchEvent(vp),this._handleMouseWheel(this._customWheelEvent(n)),this.dispatchEvent(mx))}function YR(n){this.enabled!==!1&&this._handleKeyDown(n)}function KR(n){switch(this._trackPointer(n),this._pointers.length){case 1:switch(this.touches.ONE){case sr.ROTATE:if(this.enableRotate===!1){this.state=At.NONE;break}this._handleTouchStartRotate(n),this.state=At.TOUCH_ROTATE;break;case sr.PAN:if(this.enablePan===!1){this.state=At.NONE;break}this._handleTouchStartPan(n),this.state=At.TOUCH_PAN;break;default:this.state=At.NONE}break;case 2:switch(this.touches.TWO){case sr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(n),this.state=At.TOUCH_DOLLY_PAN;break;case sr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(n),this.state=At.TOUCH_DOLLY_ROTATE;break;default:this.state=At.NONE}break;default:this.state=At.NONE}this.state!==At.NONE&&this.dispatchEvent(vp)}function ZR(n){switch(this._trackPointer(n),this.state){case At.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(n),this.update();break;case At.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(n),this.update();break;case At.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(n),this.update();break;case At.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(n),this.update();break;default:this.state=At.NONE}}function qR(n){this.enabled!==!1&&n.preventDefault()}function $R(n){n.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function JR(n){n.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function _x(n,e=!1){let t=n[0].index!==null,i=new Set(Object.keys(n[0].attributes)),s=new Set(Object.keys(n[0].morphAttributes)),r={},o={},a=n[0].morphTargetsRelative,c=new Qn;c.morphTargetsRelative=a;let l=0;for(let u=0;u<n.length;++u){let h=n[u],f=0,d=0;if(t!==(h.index!==null))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+u+". All geometries must have compatible attributes; make sure index attribute exists among all geometries, or in none of them."),null;for(let p in h.attributes){if(!i.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+u+'. All geometries must have compatible attributes; make sure "'+p+'" attribute exists among all geometries, or in none of them.'),null;r[p]===void 0&&(r[p]=[]),r[p].push(h.attributes[p]),f++}if(f!==i.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+u+". Make sure all geometries have the same number of attributes."),null;if(a!==h.morphTargetsRelative)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+u+". .morphTargetsRelative must be consistent throughout all geometries."),null;for(let p in h.morphAttributes){if(!s.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+u+".  .morphAttributes must be consistent throughout all geometries."),null;if(h.morphAttributes[p].length!==n[0].morphAttributes[p].length)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+u+'. All geometries must have the same number of morph targets for the "'+p+'" morph attribute.'),null;o[p]===void 0&&(o[p]=[]),o[p].push(h.morphAttributes[p]),d++}if(d!==s.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+u+". Make sure all geometries have the same number of morph attributes."),null;if(e){let p;if(t)p=h.index.count;else if(h.attributes.position!==void 0)p=h.attributes.position.count;else return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+u+". The geometry must have either an index or a position attribute"),null;c.addGroup(l,p,u),l+=p}}if(t){let u=0,h=[];for(let f=0;f<n.length;++f){let d=n[f].index;for(let p=0;p<d.count;++p)h.push(d.getX(p)+u);u+=n[f].attributes.position.count}c.setIndex(h)}for(let u in r){let h=gx(r[u]);if(!h)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+u+" attribute."),null;c.setAttribute(u,h)}for(let u in o){let h=o[u][0].length;if(h!==0){c.morphAttributes=c.morphAttributes||{},c.morphAttributes[u]=[];for(let f=0;f<h;++f){let d=[];for(let S=0;S<o[u].length;++S)d.push(o[u][S][f]);let p=gx(d);if(!p)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+u+" morphAttribute."),null;c.morphAttributes[u].push(p)}}}return c}function gx(n){let e,t,i,s=-1,r=0;for(let l=0;l<n.length;++l){let u=n[l];if(e===void 0&&(e=u.array.constructor),e!==u.array.constructor)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.array must be of consistent array types across matching attributes."),null;if(t===void 0&&(t=u.itemSize),t!==u.itemSize)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.itemSize must be consistent across matching attributes."),null;if(i===void 0&&(i=u.normalized),i!==u.normalized)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.normalized must be consistent across matching attributes."),null;if(s===-1&&(s=u.gpuType),s!==u.gpuType)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.gpuType must be consistent across matching attributes."),null;r+=u.count*t}let o=new e(r),a=new mn(o,t,i),c=0;for(let l=0;l<n.length;++l){let u=n[l];if(u.isInterleavedBufferAttribute){let h=c/t;for(let f=0,d=u.count;f<d;f++)for(let p=0;p<t;p++){let S=u.getComponent(f,p);a.setComponent(f+h,p,S)}}else o.set(u.array,c);c+=u.count*t}return s!==void 0&&(a.gpuType=s),a}function yx(n,e=Math.PI/3){let t=n.index?n.toNonIndexed():n,i=t.attributes.position,s=i.count,r;if(i.isBufferAttribute===!0&&i.itemSize===3&&i.normalized===!1)r=i.array;else{r=new Float64Array(s*3);for(let x=0;x<s;x++)r[3*x+0]=i.getX(x),r[3*x+1]=i.getY(x),r[3*x+2]=i.getZ(x)}let o=Math.cos(e),a=(1+1e-10)*100,c=s/3,l=new Float64Array(c*3);for(let x=0;x<c;x++){let w=9*x,A=r[w+0],_=r[w+1],T=r[w+2],F=r[w+3],D=r[w+4],P=r[w+5],B=r[w+6],G=r[w+7],N=r[w+8],V=B-F,Y=G-D,z=N-P,le=A-F,q=_-D,j=T-P,te=Y*j-z*q,fe=z*le-V*j,he=V*q-Y*le,ee=1/(Math.sqrt(te*te+fe*fe+he*he)||1);l[3*x+0]=te*ee,l[3*x+1]=fe*ee,l[3*x+2]=he*ee}let u=new Int32Array(s),h=new Float64Array(s*3),f=1;for(;f<s*2;)f<<=1;let d=f-1,p=new Int32Array(f),S=0;for(let x=0;x<s;x++){let w=3*x,A=Math.trunc(r[w+0]*a),_=Math.trunc(r[w+1]*a),T=Math.trunc(r[w+2]*a),F=(Math.imul(A,73856093)^Math.imul(_,19349663)^Math.imul(T,83492791))&d;for(;;){let D=p[F];if(D===0){let B=3*S;h[B+0]=A,h[B+1]=_,h[B+2]=T,p[F]=S+1,u[x]=S++;break}let P=3*(D-1);if(h[P+0]===A&&h[P+1]===_&&h[P+2]===T){u[x]=D-1;break}F=F+1&d}}let g=new Int32Array(S+1);for(let x=0;x<s;x++)g[u[x]+1]++;for(let x=0;x<S;x++)g[x+1]+=g[x];let m=new Int32Array(s),b=g.slice(0,S);for(let x=0;x<c;x++){let w=3*x;m[b[u[w+0]]++]=x,m[b[u[w+1]]++]=x,m[b[u[w+2]]++]=x}let I=new Float32Array(s*3);for(let x=0;x<c;x++){let w=3*x,A=l[w+0],_=l[w+1],T=l[w+2];for(let F=0;F<3;F++){let D=w+F,P=u[D],B=0,G=0,N=0;for(let Y=g[P],z=g[P+1];Y<z;Y++){let le=3*m[Y],q=l[le+0],j=l[le+1],te=l[le+2];A*q+_*j+T*te>o&&(B+=q,G+=j,N+=te)}let V=1/(Math.sqrt(B*B+G*G+N*N)||1);I[3*D+0]=B*V,I[3*D+1]=G*V,I[3*D+2]=N*V}}return t.setAttribute("normal",new mn(I,3,!1)),t}var jR=Math.PI/6,Qo=1e3,QR=65536;function yh(n){let e=n.map(({corners:t,triangles:i,isFaceted:s,lowM:r,unitM:o})=>{let a=new Qn,c=new Uint16Array(t.slice().buffer),l=Float32Array.from(c,(f,d)=>r[d%3]+f*o[d%3]);a.setAttribute("position",new mn(l,3));let u=l.length/3<=QR?Uint16Array:Uint32Array;if(a.setIndex(new mn(new Uint32Array(new u(i.slice().buffer)),1)),a.computeVertexNormals(),!s)return a;let h=a.scale(Qo,Qo,Qo);return yx(h,jR).scale(1/Qo,1/Qo,1/Qo)});return e.length===1?e[0]:_x(e)}function wl(n){n.traverse(e=>{if(!(e instanceof Ct||e instanceof Tr))return;let t=e.material;e.geometry.dispose(),t.map?.dispose(),t.dispose()}),n.removeFromParent()}var bp=1.5,eI=new pi({color:10466248,transparent:!0,opacity:.35,depthWrite:!1});function tI(n){let e=new On;for(let t of n.children)t instanceof Ct&&e.add(new Ct(t.geometry,eI));return e}var xh=class{constructor(e,t){this.robot=e;this.offset_m=t;let i=new Map;for(let{meshes:s}of e.bodies){let r=new On,o=new Map;for(let a of s){let c=2*a.colour+Number(a.isFaceted);o.set(c,[...o.get(c)??[],a])}for(let a of o.values()){let c=a[0].colour;i.has(c)||i.set(c,new pi({color:c,roughness:.45,metalness:.05}));let l=new Ct(yh(a),i.get(c));l.castShadow=l.receiveShadow=!0,r.add(l)}this.bodies.push(r),this.group.add(r)}this.group.visible=this.ghost.visible=!1}robot;offset_m;group=new On;base=new W;centre=new W;hasCentre=!1;yaw_rad=0;top_m=.5;height_m=1;bodies=[];ghost=new On;feet={left:[],right:[]};from=new bn;to=new bn;place({before:e,after:t,mix:i}){let s=(h,f,d)=>{let p=S=>f[S]+i*(d[S]-f[S]);h.set(p(0),p(1)+this.offset_m,p(2))};s(this.base,e.frame.baseM,t.frame.baseM),this.group.position.copy(this.base);let[r,o]=[e.frame.centreOfMassM,t.frame.centreOfMassM];this.hasCentre=r.length===3&&o.length===3,this.hasCentre&&s(this.centre,r,o),this.placeBodies(this.bodies,e.bodies,t.bodies,i),this.ghost.visible=e.ghost.length>0&&t.ghost.length>0,this.ghost.visible&&(this.ghost.children.length===0&&this.ghost.add(...this.bodies.map(tI)),s(this.ghost.position,e.frame.ghostBaseM,t.frame.ghostBaseM),this.placeBodies(this.ghost.children,e.ghost,t.ghost,i));let{x:a,y:c,z:l,w:u}=this.bodies[0]?.quaternion??this.from.identity();this.yaw_rad=Math.atan2(2*(u*l+a*c),1-2*(c*c+l*l)),this.group.visible||this.measure()}placeBodies(e,t,i,s){for(let[r,o]of e.entries()){let a=7*r;if(a+7>t.length||a+7>i.length)break;let c=l=>t[a+l]+s*(i[a+l]-t[a+l]);o.position.set(c(0),c(1),c(2)),this.from.fromArray(t,a+3),this.to.fromArray(i,a+3),o.quaternion.slerpQuaternions(this.from,this.to,s)}}measure(){this.group.visible=!0,this.group.updateMatrixWorld(!0);for(let{body:i,atM:s}of this.robot.feet){if(i>=this.bodies.length)continue;let{x:r,y:o}=this.bodies[i].position,a=o*Math.cos(this.yaw_rad)>r*Math.sin(this.yaw_rad);this.feet[a?"left":"right"].push({body:i,at:new W().fromArray(s)})}let{min:e,max:t}=new Ti().setFromObject(this.group);e.z>t.z||([this.top_m,this.height_m]=[t.z-this.base.z,t.z-e.z])}};var vh=class extends Er{constructor(){super(),this.name="RoomEnvironment",this.position.y=-3.5;let e=new Qs;e.deleteAttribute("uv");let t=new pi({side:Mn}),i=new pi,s=new al(16777215,900,28,2);s.position.set(.418,16.199,.3),this.add(s);let r=new Ct(e,t);r.position.set(-.757,13.219,.717),r.scale.set(31.713,28.305,28.591),this.add(r);let o=new Js(e,i,6),a=new Sn;a.position.set(-10.906,2.009,1.846),a.rotation.set(0,-.195,0),a.scale.set(2.328,7.905,4.651),a.updateMatrix(),o.setMatrixAt(0,a.matrix),a.position.set(-5.607,-.754,-.758),a.rotation.set(0,.994,0),a.scale.set(1.97,1.534,3.955),a.updateMatrix(),o.setMatrixAt(1,a.matrix),a.position.set(6.167,.857,7.803),a.rotation.set(0,.561,0),a.scale.set(3.927,6.285,3.687),a.updateMatrix(),o.setMatrixAt(2,a.matrix),a.position.set(-2.017,.018,6.124),a.rotation.set(0,.333,0),a.scale.set(2.002,4.566,2.064),a.updateMatrix(),o.setMatrixAt(3,a.matrix),a.position.set(2.291,-.756,-2.621),a.rotation.set(0,-.286,0),a.scale.set(1.546,1.552,1.496),a.updateMatrix(),o.setMatrixAt(4,a.matrix),a.position.set(-2.193,-.369,-5.547),a.rotation.set(0,.516,0),a.scale.set(3.875,3.487,2.986),a.updateMatrix(),o.setMatrixAt(5,a.matrix),this.add(o);let c=new Ct(e,ea(50));c.position.set(-16.116,14.37,8.208),c.scale.set(.1,2.428,2.739),this.add(c);let l=new Ct(e,ea(50));l.position.set(-16.109,18.021,-8.207),l.scale.set(.1,2.425,2.751),this.add(l);let u=new Ct(e,ea(17));u.position.set(14.904,12.198,-1.832),u.scale.set(.15,4.265,6.331),this.add(u);let h=new Ct(e,ea(43));h.position.set(-.462,8.89,14.52),h.scale.set(4.38,5.441,.088),this.add(h);let f=new Ct(e,ea(20));f.position.set(3.235,11.486,-12.541),f.scale.set(2.5,2,.1),this.add(f);let d=new Ct(e,ea(100));d.position.set(0,20,0),d.scale.set(1,.1,1),this.add(d)}dispose(){let e=new Set;this.traverse(t=>{t.isMesh&&(e.add(t.geometry),e.add(t.material))});for(let t of e)t.dispose()}};function ea(n){return new Ir({color:0,emissive:16777215,emissiveIntensity:n})}var xx=`// Ground with lines every metre, whose width in pixels is constant, that fades towards the horizon.
varying vec2 place_m;
uniform vec3 line_colour;
uniform vec2 centre_m;

float lines(vec2 at) {
  vec2 pixel = max(fwidth(at), vec2(1e-5));
  vec2 near = abs(fract(at - 0.5) - 0.5) / pixel;
  vec2 share = (1.0 - smoothstep(0.4, 1.4, near)) * (1.0 - smoothstep(0.1, 0.5, pixel));
  return max(share.x, share.y);
}

vec4 ground(vec4 colour) {
  vec2 cell = mod(floor(place_m), 2.0);
  colour.rgb *= 1.0 - 0.05 * abs(cell.x - cell.y);
  colour.rgb = mix(colour.rgb, line_colour, max(0.4 * lines(place_m), 0.85 * lines(place_m / 5.0)));
  colour.a *= 1.0 - smoothstep(10.0, 60.0, length(place_m - centre_m));
  return colour;
}
`;var vx={zenith:9419752,horizon:15002610,ground:11121338,line:8226965,hemisphere:.8,key:2.5},bx={zenith:725536,horizon:1910581,ground:3357767,line:5990518,hemisphere:.7,key:2.2},iI=.42,Sx=400,Mx=100,Ex=2048;function sI(n,e){let t=new Ir({transparent:!0});return t.onBeforeCompile=i=>{let s="void main() {";Object.assign(i.uniforms,{line_colour:{value:n},centre_m:{value:e}}),i.vertexShader=i.vertexShader.replace(s,`varying vec2 place_m;
${s} place_m = position.xy;`),i.fragmentShader=i.fragmentShader.replace(s,`${xx}
${s}`).replace("#include <color_fragment>","diffuseColor = ground(diffuseColor);")},t}var Sp=class{group=new On;below_m;colour;borders=[];constructor(e,t){let i=yh([e]);i.computeBoundingBox(),this.below_m=i.boundingBox.min.z-.02,this.colour=e.colour;for(let{offset_m:s}of t){let r=u=>new $n(new W(0,u,0),1e6),[o,a]=[r(-1),r(1)];this.borders.push({left:o,right:a});let c={color:e.colour,roughness:.9,clippingPlanes:[o,a]},l=new Ct(i,new pi(c));l.position.y=s,l.receiveShadow=l.castShadow=!0,this.group.add(l)}}split(e){for(let t=0;t+1<e.length;t+=1){let i=(e[t].base.y+e[t+1].base.y)/2;this.borders[t].right.constant=-i,this.borders[t+1].left.constant=i}}};function rI(n){let e=n.getExtension("WEBGL_debug_renderer_info");return e!==null&&/swiftshader|llvmpipe|software/i.test(String(n.getParameter(e.UNMASKED_RENDERER_WEBGL)))}var bh=class{constructor(e,t){this.scene=e;if(!rI(t.getContext())){let s=new $o(t);this.room=e.environment=s.fromScene(new vh,.04).texture,s.dispose()}e.environmentRotation.set(Math.PI/2,0,0),e.environmentIntensity=iI;let{shadow:i}=this.key;this.key.castShadow=this.plane.receiveShadow=!0,i.mapSize.set(Ex,Ex),[i.radius,i.bias,i.normalBias,i.camera.far]=[3,-3e-4,.012,20],this.hemisphere.position.set(0,0,1),this.dome.renderOrder=-1,e.add(this.key,this.key.target,this.hemisphere,this.plane,this.dome),this.dark.addEventListener("change",()=>this.paint()),this.paint(),this.simplify(this.room===null)}scene;key=new cl(16774374);hemisphere=new sl(16777215,9080728);line=new rt;centre=new We;grid=sI(this.line,this.centre);plane=new Ct(new wr(Sx,Sx),this.grid);dome=new Ct(new Rr(Mx,24,24).rotateX(Math.PI/2),new $s({vertexColors:!0,side:Mn,depthWrite:!1,toneMapped:!1}));dark=matchMedia("(prefers-color-scheme: dark)");terrain;room=null;isPlain=!1;simplify(e){this.isPlain=e||this.room===null,this.key.castShadow=!this.isPlain,this.scene.environment=this.isPlain?null:this.room,this.hemisphere.intensity=this.isPlain?2:(this.dark.matches?bx:vx).hemisphere}paint(){let e=this.dark.matches?bx:vx;this.grid.color.setHex(this.terrain?.colour??e.ground),this.line.setHex(e.line),this.hemisphere.intensity=this.isPlain?2:e.hemisphere,this.key.intensity=e.key;let t=this.dome.geometry.getAttribute("position"),i=new mn(new Float32Array(3*t.count),3),[s,r,o]=[new rt(e.horizon),new rt(e.zenith),new rt];for(let a=0;a<t.count;a+=1){let c=Math.max(0,t.getZ(a)/Mx);o.lerpColors(s,r,Math.sqrt(c)).toArray(i.array,3*a)}this.dome.geometry.setAttribute("color",i)}setGround(e,t){this.terrain!==void 0&&wl(this.terrain.group),this.terrain=e&&new Sp(e,t),this.terrain!==void 0&&this.scene.add(this.terrain.group),this.plane.position.z=this.terrain?.below_m??0,this.paint();let{camera:i}=this.key.shadow;i.right=i.top=1.6+.75*t.length,i.left=i.bottom=-i.right,i.updateProjectionMatrix()}follow(e,t,i){let{position:s}=this.plane;[s.x,s.y]=[10*Math.round(e.x/10),10*Math.round(e.y/10)],this.centre.set(e.x-s.x,e.y-s.y),this.dome.position.copy(t),this.key.target.position.copy(e),this.key.position.set(e.x+3,e.y-3.5,e.z+7),this.terrain?.split(i)}};var oI=2,aI=.75,lI=.3,cI=.028,uI=.15,hI=3,fI=.02,dI=3,pI=2,mI=1,Tx=.12,gI=.6,Ax=.022,wx=26;function _I(n){let e=wx/2,t=n.length>wx?`${n.slice(0,e)}…${n.slice(-e)}`:n,i=document.createElement("canvas"),s=i.getContext("2d"),r="600 44px system-ui, sans-serif";s.font=r,i.width=Math.ceil(s.measureText(t).width)+48,i.height=72,Object.assign(s,{font:r,fillStyle:"rgba(16, 22, 32, 0.78)",textBaseline:"middle"}),s.roundRect(0,0,i.width,i.height,24),s.fill(),s.fillStyle="#ffffff",s.fillText(t,24,38);let o=new Qa(i);o.colorSpace=qn;let a={map:o,sizeAttenuation:!1,depthTest:!1,toneMapped:!1},c=new Tr(new Bo(a));return c.scale.set(Ax*i.width/i.height,Ax,1),c.center.set(.5,0),c.renderOrder=2,c}var Sh=class{constructor(e){this.canvas=e;this.renderer=new rh({canvas:e,antialias:!0,powerPreference:"high-performance"}),this.renderer.toneMapping=hl,this.renderer.shadowMap.enabled=this.renderer.localClippingEnabled=!0,this.renderer.shadowMap.type=Cr,this.surroundings=new bh(this.scene,this.renderer),this.scene.add(this.arrows.group),this.camera.up.set(0,0,1),this.controls=new _h(this.camera,e),[this.controls.minDistance,this.controls.maxDistance]=[.4,60],this.controls.maxPolarAngle=Math.PI/2+.1,[this.controls.enableDamping,this.controls.dampingFactor]=[!this.still,.15],this.reset(),e.addEventListener("dblclick",()=>this.reset())}canvas;arrows=new uh;robots=[];following=!0;renderer;scene=new Er;camera=new Gn(38,1,.05,250);controls;surroundings;middle=new W(0,0,.8);shift=new W;still=matchMedia("(prefers-reduced-motion: reduce)").matches;labels=[];framed=!1;frame_s=.016;verySlow=0;best=Math.min(devicePixelRatio,oI);ratio=this.best;size="";quick_s=0;improvements=0;covered=[0,0,0,0];aspect=1;cover(...e){this.covered=e;let[t,i,s,r]=e,{clientWidth:o,clientHeight:a}=this.canvas;if(o===0||a===0)return;let c=`${this.ratio} ${o} ${a}`;c!==this.size&&(this.renderer.setPixelRatio(this.ratio),this.renderer.setSize(o,a,!1),this.size=c);let l=this.aspect,u=Math.max(.15*a,a-s-r);this.aspect=Math.max(.2*o,o-t-i)/u,this.robots.length>1&&this.aspect<.9*l&&(this.framed=!1),this.camera.aspect=o/a,this.camera.zoom=u/a,this.camera.setViewOffset(o,a,(i-t)/2,(r-s)/2,o,a)}setRobots(e){for(let{group:i,ghost:s}of this.robots)[i,s].forEach(wl);this.labels.forEach(wl);let t=(e.length-1)/2;this.robots=e.map((i,s)=>new xh(i,(t-s)*bp)),this.labels=e.length>1?e.map(i=>_I(i.name)):[],this.scene.add(...this.robots.flatMap(({group:i,ghost:s})=>[i,s]),...this.labels),this.framed=!1}setGround(e){this.arrows.isFlat=e===void 0,this.surroundings.setGround(e,this.robots)}reset(){let e=Math.max(.4,...this.robots.map(o=>o.height_m)),t=Math.max(.7*e,bp*(this.robots.length-1)+1),i=2*Math.tan(this.camera.fov*Math.PI/360),s=Math.max(e/(.58*i),t/(.9*i*this.aspect)),r=this.robots.length>1?.35:.85;this.shift.set(Math.cos(r),-Math.sin(r),.32).setLength(s),this.controls.target.copy(this.middle),this.camera.position.copy(this.middle).add(this.shift),this.controls.update()}draw(e,t){for(let[i,s]of this.robots.entries()){let r=e.sample(i);r!==void 0&&(s.place(r),this.labels[i]?.position.copy(s.base).setZ(s.base.z+s.top_m+.22))}this.arrows.draw(this.robots,e),this.follow(t),this.controls.update(),this.stagger(),this.surroundings.follow(this.middle,this.camera.position,this.robots),this.adapt(t),this.renderer.render(this.scene,this.camera)}stagger(){this.camera.updateMatrixWorld();let e=this.camera.projectionMatrix.elements,t=[];for(let i of this.labels){let{x:s,y:r}=this.shift.copy(i.position).project(this.camera),[o,a]=[.5*i.scale.x*e[0],i.scale.y*e[5]],c={x:Math.max(o-1,Math.min(1-o,s)),y:r,half:o},l=t.filter(u=>Math.abs(u.x-c.x)<u.half+o);for(let u of l.sort((h,f)=>h.y-f.y))Math.abs(u.y-c.y)<a&&(c.y=u.y+1.1*a);t.push(c),i.center.set(.5-(c.x-s)/(2*o),(r-c.y)/a)}}follow(e){let t=this.robots.filter(r=>r.group.visible);if(t.length===0)return;this.middle.set(0,0,0);for(let r of t)this.middle.addScaledVector(r.base,1/t.length);if(this.framed||this.reset(),this.framed=!0,!this.following)return;this.shift.subVectors(this.middle,this.controls.target);let i=this.still||Math.hypot(this.shift.x,this.shift.y)>mI,s=r=>i?1:1-Math.exp(-e/r);this.shift.x*=s(Tx),this.shift.y*=s(Tx),this.shift.z*=s(gI),this.controls.target.add(this.shift),this.camera.position.add(this.shift)}adapt(e){this.verySlow=e>uI?this.verySlow+1:0,this.verySlow>=hI&&(this.surroundings.simplify(!0),this.lower(lI,.5)),!(e>1)&&(this.quick_s=e<fI?this.quick_s+e:0,this.quick_s>dI&&this.ratio<this.best&&this.improvements<pI&&([this.quick_s,this.ratio]=[0,this.best],this.improvements+=1,this.surroundings.simplify(!1),this.cover(...this.covered)),this.frame_s+=.03*(e-this.frame_s),this.frame_s>cI&&this.lower(aI,.75))}lower(e,t){[this.frame_s,this.verySlow]=[.016,0],!(this.ratio<=e)&&(this.ratio=Math.max(e,t*this.ratio),this.cover(...this.covered))}picture(e){let{ratio:t}=this;this.ratio=this.best,this.cover(...this.covered),this.draw(e,0);let i=new Promise(s=>this.canvas.toBlob(s,"image/png"));return this.ratio=t,this.cover(...this.covered),i}};var yI=80,xI=240,wi=new lh,Wi=new Sh(De("view")),vI=new mh(wi,Wi),Nx=new dh(wi),Mh=new hc,Eh=new fh,Rx="",Lx=new dc(bI,(n,e)=>{(e!==""||n)&&(Rx=e),Jt(De("banner"),Rx||"Connection lost; trying again"),De("banner").hidden=n,document.body.classList.toggle("lost",!n),n&&(Mh.restart(),Eh.restart(),Or.reconnect())}),Or=new ph(Lx),Rl=[];function bI({kind:n}){n.case==="scene"?SI(n.value):n.case==="frame"?wi.add(n.value):n.case==="curves"?Mh.add(n.value):n.case==="notice"?Jt(De("notice"),n.value):n.case==="status"?Eh.add(n.value):n.case==="steerer"&&Or.setSteerer(n.value)}function SI(n){document.title=n.title||"Treadmill",Jt(De("title"),document.title);let e=(t,i)=>mf(e_,t,Rl[i]);(Rl.length!==n.robots.length||!n.robots.every(e))&&(Rl=n.robots,wi.clear(),Wi.setRobots(Rl),Nx.setRobots(Rl)),Wi.setGround(n.ground),Or.setScene(n)}function MI(){let n=r=>De(r).getBoundingClientRect(),e=getComputedStyle(De("tabs")).display!=="none",[t,i]=e?[0,0]:[n("steer").right,innerWidth-n("numbers").left],s=Math.max(n("title").bottom,n("alarms").bottom);Wi.cover(t,i,s,innerHeight-n("transport").top)}for(let n of Qy){let e=ei(n==="left"||n==="right"?"show-feet":`show-${n}`),t=()=>Wi.arrows.rods[n].group.visible=e.checked;e.addEventListener("change",t),t()}ei("follow").addEventListener("change",()=>Wi.following=ei("follow").checked);var Dx=De("help");De("help-open").addEventListener("click",()=>Dx.showModal());uo(n=>{n==="?"&&Dx.showModal(),n==="f"&&ei("follow").click()});for(let n of document.querySelectorAll(".head"))n.addEventListener("click",()=>n.ariaExpanded=String(n.ariaExpanded!=="true"));var EI=new ResizeObserver(MI);for(let n of["view","steer","numbers","curves","fleet","alarms","transport"])EI.observe(De(n));var Ix=performance.now(),Cx=0,Ux=[],Ox=[];function Px(n,e){n.push(e)>xI&&n.shift()}function Fx(n){requestAnimationFrame(Fx);let e=Math.max(0,n-Ix)/1e3;if(Ix=n,Px(Ux,1e3*e),wi.advance(Math.min(e,.5)),Wi.draw(wi,e),Px(Ox,1e3*wi.age_s),Or.poll(n),n-Cx<yI)return;Cx=n,vI.update(),Nx.update(),Or.update(wi.sample(0)?.before.frame??wi.newest(0));let t=Mh.update();De("curves").hidden=De("tab-curves").hidden=!t;let i=Eh.update(n);De("fleet").hidden=De("tab-fleet").hidden=!i}requestAnimationFrame(Fx);function TI(){let n=wi.sample(0),e=Wi.robots[0];if(n===void 0||e===void 0)return;let{episode:t,timeS:i,command:s,velocity:r,anglesMrad:o}=(n.mix<.5?n.before:n.after).frame,a=({x:c,y:l,z:u})=>[c,l-e.offset_m,u];return{robot:0,episode:Number(t),time_s:i,shown_s:wi.time_s,command:s,velocity:r,base_m:a(e.base),bodies_m:e.bodies.map(c=>a(c.position.clone().add(e.base))),angles_rad:o.map(c=>c/1e3),centre_of_mass_m:e.hasCentre?a(e.centre):void 0}}var AI={shown:TI,frames:()=>wi.received,robots:()=>Wi.robots.length,bodies:()=>Wi.robots.map(({bodies:n})=>n.filter(({children:e})=>e.length>0).length),ghosts:()=>Wi.robots.filter(({ghost:n})=>n.visible).length,connected:()=>Lx.connected,steers:()=>Or.steers,othersSteer:()=>Or.othersSteer,fleet:()=>Eh.counts,bands:()=>Mh.bands,frameTimes:()=>[...Ux],latencies:()=>[...Ox]};Object.assign(window,{treadmill:AI});
